/* SPDX-License-Identifier: MIT */
#include "device/backend.h"
#include "unit_test.h"

TEST(every_backend_is_found_by_its_name) {
    assert_ptr_equal(hd_backend_find("cuda"), &hd_backend_cuda);
    assert_ptr_equal(hd_backend_find("opencl"), &hd_backend_opencl);
    assert_ptr_equal(hd_backend_find("c"), &hd_backend_c);
    assert_null(hd_backend_find("d"));
    assert_null(hd_backend_find(""));
}

TEST(plain_c_is_always_there) {
    assert_ptr_equal(hd_backend_always_there(), &hd_backend_c);
    assert_true(hd_backend_always_there()->needs_no_driver);
}
