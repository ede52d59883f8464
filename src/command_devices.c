/* SPDX-License-Identifier: MIT */
#include "commands.h"

static void print_device(const HdDevice *device) {
    printf("  %d  %s\n", device->index, device->name);
    printf("     %s\n", device->driver);
    if (device->unusable[0] != '\0')
        printf("     cannot be used: %s\n", device->unusable);
    printf("     %s, double precision: %s, strict arithmetic: %s%s\n",
           device->is_cpu ? "CPU" : "GPU", device->has_double ? "yes" : "no",
           device->not_strict[0] == '\0' ? "yes" : "no, ", device->not_strict);
}

HdStatus hd_command_devices(HdError *error) {
    static HdDevice devices[HD_MAX_DEVICES];
    for (int i = 0; i < HD_BACKEND_COUNT; i++) {
        int count = 0;
        printf("%s\n", hd_backends[i]->name);
        if (hd_backends[i]->enumerate(devices, HD_MAX_DEVICES, &count, error) != HD_OK)
            printf("  not available: %s\n", error->message);
        for (int j = 0; j < count; j++)
            print_device(&devices[j]);
    }
    return HD_OK;
}
