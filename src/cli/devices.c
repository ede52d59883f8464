/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>

#include "base/text.h"
#include "cli/options.h"
#include "input/json/json_device_text.h"
#include "output/fingerprint.h"
#include "render/backends.h"

/* What a driver says may command a terminal. */
static void print_text(const char *before, const char *text) {
    char escaped[6 * sizeof((HdDevice *)NULL)->unusable];
    hd_escape(text, escaped, sizeof escaped);
    printf("%s%s\n", before, escaped);
}

static void print_device(const HdDevice *device) {
    printf("  %d", device->index);
    print_text("  ", device->name);
    print_text("     ", device->driver);
    if (device->unusable[0] != '\0')
        print_text("     cannot be used: ", device->unusable);
    const char *strict = device->not_strict[0] != '\0' ? "no, " : "yes";
    printf("     %s, double precision: %s, strict arithmetic: %s%s\n",
           device->is_cpu ? "CPU" : "GPU", device->has_double ? "yes" : "no",
           device->is_measured ? strict : "not measured yet (hedron selftest does)",
           device->not_strict);
}

static void print_backend(const HdBackend *backend, const HdDevice *devices, int count,
                          const char *obstacle) {
    printf("%s\n", backend->name);
    if (obstacle != NULL)
        print_text("  not available: ", obstacle);
    for (int i = 0; i < count; i++)
        print_device(&devices[i]);
}

static json_t *describe_device(const HdDevice *device) {
    return json_pack(
        "{s:s, s:i, s:o, s:o, s:b, s:i, s:i, s:b, s:o, s:b, s:o}", "backend", device->backend->name,
        "index", device->index, "name", hd_json_device_text(device->name), "driver",
        hd_json_device_text(device->driver), "is_cpu", device->is_cpu, "compute_units",
        device->compute_units, "clock_mhz", device->clock_mhz, "has_double", device->has_double,
        "unusable", hd_json_text_or_null(device->unusable), "is_measured", device->is_measured,
        "not_strict", hd_json_text_or_null(device->not_strict));
}

static json_t *describe_backend(const HdBackend *backend, const HdDevice *devices, int count,
                                const char *obstacle) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        list = hd_json_append(list, describe_device(&devices[i]));
    return json_pack("{s:s, s:b, s:o, s:o}", "name", backend->name, "available", obstacle == NULL,
                     "reason", hd_json_text_or_null(obstacle), "devices", list);
}

HdStatus hd_command_devices(const HdOptions *options, HdError *error) {
    static HdDevice devices[HD_MAX_DEVICES];
    json_t *list = options->json ? json_array() : NULL;
    for (int i = 0; i < HD_BACKEND_COUNT; i++) {
        const HdBackend *backend = hd_backends[i];
        int count = 0;
        bool found = hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error) == HD_OK;
        const char *obstacle = found ? NULL : error->message;
        if (options->json)
            list = hd_json_append(list, describe_backend(backend, devices, count, obstacle));
        else
            print_backend(backend, devices, count, obstacle);
    }
    return options->json ? hd_json_print(json_pack("{s:s, s:o}", "kernels", hd_kernels_hash,
                                                   "backends", list),
                                         "the list of devices", error)
                         : HD_OK;
}
