/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "device/opencl/devices.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/minmax.h"
#include "base/text.h"
#include "system/machine.h"

/* ---- errors ---- */

#define NAME(code) [-(code)] = #code

static const char *const names[] = {NAME(CL_DEVICE_NOT_FOUND),
                                    NAME(CL_DEVICE_NOT_AVAILABLE),
                                    NAME(CL_COMPILER_NOT_AVAILABLE),
                                    NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE),
                                    NAME(CL_OUT_OF_RESOURCES),
                                    NAME(CL_OUT_OF_HOST_MEMORY),
                                    NAME(CL_PROFILING_INFO_NOT_AVAILABLE),
                                    NAME(CL_MEM_COPY_OVERLAP),
                                    NAME(CL_IMAGE_FORMAT_MISMATCH),
                                    NAME(CL_IMAGE_FORMAT_NOT_SUPPORTED),
                                    NAME(CL_BUILD_PROGRAM_FAILURE),
                                    NAME(CL_MAP_FAILURE),
                                    NAME(CL_MISALIGNED_SUB_BUFFER_OFFSET),
                                    NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
                                    NAME(CL_COMPILE_PROGRAM_FAILURE),
                                    NAME(CL_LINKER_NOT_AVAILABLE),
                                    NAME(CL_LINK_PROGRAM_FAILURE),
                                    NAME(CL_DEVICE_PARTITION_FAILED),
                                    NAME(CL_KERNEL_ARG_INFO_NOT_AVAILABLE),
                                    NAME(CL_INVALID_VALUE),
                                    NAME(CL_INVALID_DEVICE_TYPE),
                                    NAME(CL_INVALID_PLATFORM),
                                    NAME(CL_INVALID_DEVICE),
                                    NAME(CL_INVALID_CONTEXT),
                                    NAME(CL_INVALID_QUEUE_PROPERTIES),
                                    NAME(CL_INVALID_COMMAND_QUEUE),
                                    NAME(CL_INVALID_HOST_PTR),
                                    NAME(CL_INVALID_MEM_OBJECT),
                                    NAME(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR),
                                    NAME(CL_INVALID_IMAGE_SIZE),
                                    NAME(CL_INVALID_SAMPLER),
                                    NAME(CL_INVALID_BINARY),
                                    NAME(CL_INVALID_BUILD_OPTIONS),
                                    NAME(CL_INVALID_PROGRAM),
                                    NAME(CL_INVALID_PROGRAM_EXECUTABLE),
                                    NAME(CL_INVALID_KERNEL_NAME),
                                    NAME(CL_INVALID_KERNEL_DEFINITION),
                                    NAME(CL_INVALID_KERNEL),
                                    NAME(CL_INVALID_ARG_INDEX),
                                    NAME(CL_INVALID_ARG_VALUE),
                                    NAME(CL_INVALID_ARG_SIZE),
                                    NAME(CL_INVALID_KERNEL_ARGS),
                                    NAME(CL_INVALID_WORK_DIMENSION),
                                    NAME(CL_INVALID_WORK_GROUP_SIZE),
                                    NAME(CL_INVALID_WORK_ITEM_SIZE),
                                    NAME(CL_INVALID_GLOBAL_OFFSET),
                                    NAME(CL_INVALID_EVENT_WAIT_LIST),
                                    NAME(CL_INVALID_EVENT),
                                    NAME(CL_INVALID_OPERATION),
                                    NAME(CL_INVALID_GL_OBJECT),
                                    NAME(CL_INVALID_BUFFER_SIZE),
                                    NAME(CL_INVALID_MIP_LEVEL),
                                    NAME(CL_INVALID_GLOBAL_WORK_SIZE),
                                    NAME(CL_INVALID_PROPERTY),
                                    NAME(CL_INVALID_IMAGE_DESCRIPTOR),
                                    NAME(CL_INVALID_COMPILER_OPTIONS),
                                    NAME(CL_INVALID_LINKER_OPTIONS),
                                    NAME(CL_INVALID_DEVICE_PARTITION_COUNT)};

#undef NAME

const char *hd_opencl_error_name(cl_int code) {
    enum { COUNT = sizeof names / sizeof *names };
    enum { PLATFORM_NOT_FOUND_KHR = -1001 }; /* the ICD loader's own, in cl_ext.h */
    if (code == PLATFORM_NOT_FOUND_KHR)
        return "CL_PLATFORM_NOT_FOUND_KHR";
    bool is_known = code < 0 && code > -COUNT && names[-code] != NULL;
    return is_known ? names[-code] : "an unknown error";
}

/* Drivers report a kernel's failure to those who wait for it; NVIDIA's has only a number of its own
   for a crash. */
static bool is_lost(const char *function, cl_int code) {
    enum { NVIDIA_ILLEGAL_ACCESS = -9999 };
    bool waits = strcmp(function, "clFinish") == 0 || strcmp(function, "clWaitForEvents") == 0 ||
                 strcmp(function, "clEnqueueReadBuffer") == 0;
    switch (code) {
    case CL_DEVICE_NOT_AVAILABLE:
    case CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST:
    case CL_INVALID_COMMAND_QUEUE:
    case CL_INVALID_CONTEXT:
    case CL_INVALID_DEVICE:
    case NVIDIA_ILLEGAL_ACCESS:
        return true;
    case CL_OUT_OF_RESOURCES: /* other functions: a lack of memory */
        return waits;
    default:
        return false;
    }
}

HdStatus hd_opencl_fail(HdError *error, const char *function, cl_int code) {
    char what[256];
    snprintf(what, sizeof what, "%s failed with %s (%d)", function, hd_opencl_error_name(code),
             (int)code);
    return is_lost(function, code) ? hd_fail_lost(error, what)
                                   : hd_fail(error, HD_FAILED, "%s", what);
}

/* ---- devices ---- */

enum { MAX_PLATFORMS = 32 };

typedef struct Entry {
    const HdOpenclLibrary *cl;
    cl_platform_id platform;
    cl_device_id device;
} Entry;

/* A failing query counts as "no": an OpenCL 1.0 device does not know every query. */
static cl_ulong query(Entry of, cl_device_info what) {
    union {
        cl_ulong wide;
        cl_uint narrow;
    } value;
    size_t size = 0;
    if (of.cl->clGetDeviceInfo(of.device, what, sizeof value, &value, &size) != CL_SUCCESS)
        return 0;
    return size == sizeof value.wide ? value.wide : value.narrow;
}

static int query_int(Entry of, cl_device_info what) {
    return (int)query(of, what);
}

/* Queries a device or, if the entry has none, a platform. */
static cl_int query_bytes(Entry of, cl_uint what, size_t size, void *value, size_t *needed) {
    return of.device ? of.cl->clGetDeviceInfo(of.device, what, size, value, needed)
                     : of.cl->clGetPlatformInfo(of.platform, what, size, value, needed);
}

/* Trims spaces at both ends. OpenCL fails if the buffer is too small. */
static void query_text(Entry of, cl_uint what, char *text, size_t capacity) {
    text[0] = '\0';
    size_t size = 0;
    if (query_bytes(of, what, 0, NULL, &size) != CL_SUCCESS || size == 0 ||
        size > HD_OPENCL_MAX_BYTES)
        return;
    char *whole = calloc(size + 1, 1);
    if (whole && query_bytes(of, what, size, whole, NULL) == CL_SUCCESS) {
        const char *start = whole;
        while (isspace((unsigned char)*start))
            start++;
        size_t length = strlen(start);
        while (length > 0 && isspace((unsigned char)start[length - 1]))
            length--;
        snprintf(text, capacity, "%.*s", (int)length, start);
    }
    free(whole);
}

/* Writes the reason why no kernel can run; empty: usable. */
static void find_unsupported(Entry entry, char *reasons, size_t capacity) {
    char version[64];
    int major = 0, minor = 0;
    query_text(entry, CL_DEVICE_VERSION, version, sizeof version);
    bool is_known = sscanf(version, "OpenCL %d.%d", &major, &minor) == 2;
    bool is_12 = is_known && (major > 1 || (major == 1 && minor >= 2));
    const struct {
        bool is_met;
        const char *reason;
    } list[] = {{query(entry, CL_DEVICE_AVAILABLE), "it is not available"},
                {query(entry, CL_DEVICE_COMPILER_AVAILABLE), "its driver has no compiler"},
                {is_12, "it is older than OpenCL 1.2"},
                {query(entry, CL_DEVICE_ENDIAN_LITTLE), "it is not little-endian"}};
    reasons[0] = '\0';
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        if (!list[i].is_met)
            hd_add_text(reasons, capacity, ", ", "%s", list[i].reason);
}

static bool has_extension(Entry entry, const char *name) {
    char extensions[8192];
    query_text(entry, CL_DEVICE_EXTENSIONS, extensions, sizeof extensions);
    return strstr(extensions, name) != NULL;
}

/* Only NVIDIA's driver reports this. */
static bool has_timeout(Entry entry) {
    enum { KERNEL_EXEC_TIMEOUT_NV = 0x4005 };
    cl_bool reported = CL_FALSE;
    if (query_bytes(entry, KERNEL_EXEC_TIMEOUT_NV, sizeof reported, &reported, NULL) == CL_SUCCESS)
        return reported != CL_FALSE || hd_display_may_be_there(HD_DISPLAY_FOLDER);
    return (query(entry, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU) == 0;
}

static void describe_device(HdDevice *device, Entry entry, int index) {
    enum { CAPABILITY_MAJOR = 0x4000, CAPABILITY_MINOR = 0x4001 };
    memset(device, 0, sizeof *device);
    device->index = index;
    char platform[80], version[80], driver[48];
    query_text((Entry){.cl = entry.cl, .platform = entry.platform}, CL_PLATFORM_NAME, platform,
               sizeof platform);
    query_text(entry, CL_DEVICE_VERSION, version, sizeof version);
    query_text(entry, CL_DRIVER_VERSION, driver, sizeof driver);
    query_text(entry, CL_DEVICE_NAME, device->name, sizeof device->name);
    snprintf(device->driver, sizeof device->driver, "%s, %s, driver %s", platform, version, driver);
    device->is_cpu = query(entry, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU;
    for (int p = HD_PRECISION_FLOAT; p <= HD_PRECISION_DOUBLE; p++)
        device->lanes[p] = 1 | 4 | 8 | 16;
    device->compute_units = query_int(entry, CL_DEVICE_MAX_COMPUTE_UNITS);
    device->clock_mhz = query_int(entry, CL_DEVICE_MAX_CLOCK_FREQUENCY);
    /* NVIDIA's extensions: the build option -cl-nv-maxrregcount, and the query of the version. */
    if (has_extension(entry, "cl_nv_compiler_options"))
        device->nvidia_arch =
            10 * query_int(entry, CAPABILITY_MAJOR) + query_int(entry, CAPABILITY_MINOR);
    device->has_double = query(entry, CL_DEVICE_DOUBLE_FP_CONFIG) != 0;
    device->has_wide_atomics = has_extension(entry, "cl_khr_int64_base_atomics");
    device->has_timeout = has_timeout(entry);
    find_unsupported(entry, device->unusable, sizeof device->unusable);
}

static HdStatus list_platforms(const HdOpenclLibrary *cl, cl_platform_id platforms[MAX_PLATFORMS],
                               cl_uint *count, HdError *error) {
    cl_int code = cl->clGetPlatformIDs(MAX_PLATFORMS, platforms, count);
    if (code != CL_SUCCESS || *count == 0)
        return hd_fail(error, HD_UNAVAILABLE,
                       "no OpenCL platform is installed (the ICD loader reports %s); a "
                       "graphics driver or the package pocl-opencl-icd brings one",
                       code == CL_SUCCESS ? "none" : hd_opencl_error_name(code));
    if (*count > MAX_PLATFORMS)
        *count = MAX_PLATFORMS;
    return HD_OK;
}

/* Writes the name of PoCL's cache folder, by PoCL's rules. */
static void find_pocl_cache(char folder[HD_MAX_PATH]) {
    const char *named = getenv("POCL_CACHE_DIR"), *caches = getenv("XDG_CACHE_HOME"),
               *home = getenv("HOME");
    if (named != NULL)
        snprintf(folder, HD_MAX_PATH, "%s", named);
    else if (caches != NULL && caches[0] != '\0')
        snprintf(folder, HD_MAX_PATH, "%s/pocl/kcache", caches);
    else
        snprintf(folder, HD_MAX_PATH, "%s/.cache/pocl/kcache", home != NULL ? home : "/tmp");
}

bool hd_pocl_lacks_cache(const char *driver, char fault[HD_POCL_FAULT_SIZE]) {
    static const char pocl[] = "Portable Computing Language";
    char folder[HD_MAX_PATH], entry[HD_MAX_PATH + 2];
    HdError ignored;
    if (strncmp(driver, pocl, strlen(pocl)) != 0)
        return false;
    find_pocl_cache(folder);
    snprintf(entry, sizeof entry, "%s/x", folder);
    if (hd_path_make_parents(entry, S_IRWXU, &ignored) == HD_OK && access(folder, W_OK) == 0)
        return false;
    snprintf(fault, HD_POCL_FAULT_SIZE,
             "PoCL cannot write to its cache folder %s, expected POCL_CACHE_DIR to name a folder "
             "for it",
             folder);
    return true;
}

static HdStatus fail_without_devices(const HdOpenclLibrary *cl, const cl_platform_id *platforms,
                                     cl_uint count, cl_int code, HdError *error) {
    char first[80] = "", name[80], fault[HD_POCL_FAULT_SIZE];
    snprintf(fault, sizeof fault, "%s", hd_opencl_error_name(code));
    for (cl_uint p = 0; p < count; p++) {
        query_text((Entry){.cl = cl, .platform = platforms[p]}, CL_PLATFORM_NAME, name,
                   sizeof name);
        if (p == 0)
            memcpy(first, name, sizeof first);
        if (hd_pocl_lacks_cache(name, fault))
            break;
    }
    return hd_fail(error, HD_UNAVAILABLE,
                   "none of the %u installed OpenCL platforms (%s%s) has a device: %s",
                   (unsigned)count, first, count > 1 ? ", ..." : "", fault);
}

static HdStatus list_devices(const HdOpenclLibrary *cl, Entry *entries, int capacity, int *count,
                             HdError *error) {
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint platform_count = 0;
    *count = 0;
    HD_TRY(list_platforms(cl, platforms, &platform_count, error));
    const cl_device_type types =
        CL_DEVICE_TYPE_CPU | CL_DEVICE_TYPE_GPU | CL_DEVICE_TYPE_ACCELERATOR;
    cl_int last_code = CL_DEVICE_NOT_FOUND;
    for (cl_uint p = 0; p < platform_count && *count < capacity; p++) {
        cl_device_id devices[HD_MAX_DEVICES] = {NULL};
        cl_uint found = 0;
        cl_int code = cl->clGetDeviceIDs(platforms[p], types, HD_MAX_DEVICES, devices, &found);
        if (code != CL_SUCCESS) {
            last_code = code;
            continue;
        }
        /* A driver may claim more devices than it lists. */
        for (cl_uint d = 0; d < found && d < HD_MAX_DEVICES && *count < capacity; d++)
            if (devices[d] != NULL)
                entries[(*count)++] = (Entry){cl, platforms[p], devices[d]};
    }
    if (*count > 0)
        return HD_OK;
    return fail_without_devices(cl, platforms, platform_count, last_code, error);
}

HdStatus hd_opencl_enumerate(HdDevice *devices, int capacity, int *count, HdError *error) {
    HdOpenclLibrary cl;
    Entry entries[HD_MAX_DEVICES];
    *count = 0;
    HD_TRY(hd_opencl_load_library(&cl, error));
    HdStatus status = list_devices(&cl, entries, hd_min(capacity, HD_MAX_DEVICES), count, error);
    for (int i = 0; i < *count; i++)
        describe_device(&devices[i], entries[i], i);
    return status;
}

HdStatus hd_opencl_find(const HdOpenclLibrary *cl, cl_device_id *device, int index,
                        HdGpuFacts *facts, HdError *error) {
    Entry entries[HD_MAX_DEVICES];
    int count;
    HD_TRY(list_devices(cl, entries, HD_MAX_DEVICES, &count, error));
    if (index < 0 || index >= count)
        return hd_fail(error, HD_UNAVAILABLE, "there is no device %d, only 0 to %d", index,
                       count - 1);
    const Entry entry = entries[index];
    *device = entry.device;
    *facts = (HdGpuFacts){
        .memory = query(entry, CL_DEVICE_GLOBAL_MEM_SIZE),
        .at_once = query(entry, CL_DEVICE_MAX_MEM_ALLOC_SIZE),
        .native_lanes = {query_int(entry, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT),
                         query_int(entry, CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE)},
    };
    return HD_OK;
}
