/* SPDX-License-Identifier: MIT */
#include "device/backend.h"
#include "expect.h"

static void every_backend_is_found_by_its_name(void **state) {
    (void)state;
    assert_ptr_equal(hd_backend_find("cuda"), &hd_backend_cuda);
    assert_ptr_equal(hd_backend_find("opencl"), &hd_backend_opencl);
    assert_ptr_equal(hd_backend_find("c"), &hd_backend_c);
    assert_null(hd_backend_find("d"));
    assert_null(hd_backend_find(""));
}

static void plain_c_is_always_there(void **state) {
    (void)state;
    assert_ptr_equal(hd_backend_always_there(), &hd_backend_c);
    assert_true(hd_backend_always_there()->needs_no_driver);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_backend_is_found_by_its_name),
        cmocka_unit_test(plain_c_is_always_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
