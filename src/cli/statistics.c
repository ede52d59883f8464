/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cli/statistics.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/statistics_line.h"
#include "system/atomic_file.h"
#include "system/interrupt.h"

/* Nanoseconds are enough for a run of days. */
enum { SIGNIFICANT_DIGITS = 12 };

/* Fails with HD_INTERRUPTED if a signal ended the wait: writing waits for a slow reader of a pipe,
   opening for a missing one. */
static HdStatus fail_to_write(const HdStatistics *statistics, HdError *error) {
    if (errno == EINTR && hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted while writing the statistics to %s",
                       statistics->name);
    return hd_fail(error, HD_FAILED, "cannot write the statistics to %s: %s", statistics->name,
                   strerror(errno));
}

static bool has_other_json(const char *file) {
    static const char expected[] = "{\"frame\"";
    char begin[sizeof expected - 1] = "";
    struct stat found;
    if (stat(file, &found) != 0 || !S_ISREG(found.st_mode))
        return false;
    FILE *stream = fopen(file, "rb");
    if (stream == NULL)
        return false;
    size_t count = fread(begin, 1, sizeof begin, stream);
    fclose(stream);
    return count > 0 && begin[0] == '{' && memcmp(begin, expected, sizeof begin) != 0;
}

HdStatus hd_statistics_settle(HdStatistics *statistics, const char *path, const char *scene,
                              const HdOutputPlan *plan, int frame_number, HdError *error) {
    char *file = statistics->name, output[HD_MAX_PATH];
    *statistics = (HdStatistics){.stream = NULL};
    if (path == NULL)
        return HD_OK;
    statistics->is_standard_output = strcmp(path, "-") == 0;
    if (statistics->is_standard_output) {
        snprintf(file, HD_MAX_PATH, "standard output");
        return HD_OK;
    }
    if (hd_path_expand_home(path, file, error) != HD_OK)
        return error->status;
    if (scene != NULL && hd_path_is_same(file, scene))
        return hd_fail(error, HD_BAD_INPUT, "--stats is '%s', which is the scene", path);
    for (int i = 0; i < plan->count; i++) {
        HD_TRY(hd_output_file(&plan->list[i], frame_number, output, error));
        if (hd_path_is_same(file, output))
            return hd_fail(error, HD_BAD_INPUT, "--stats is '%s', which is an output", path);
    }
    if (has_other_json(file))
        return hd_fail(error, HD_BAD_INPUT,
                       "--stats is '%s', which has other JSON in it, expected a new file or one "
                       "with statistics",
                       path);
    return HD_OK;
}

HdStatus hd_statistics_open(HdStatistics *statistics, HdError *error) {
    if (statistics->is_standard_output)
        statistics->stream = stdout;
    if (statistics->is_standard_output || statistics->name[0] == '\0')
        return HD_OK;
    HD_TRY(hd_path_make_parents(statistics->name, 0777, error));
    errno = EINTR;
    if (hd_interrupt_signal() == 0)
        statistics->stream = fopen(statistics->name, "we"); /* closed in child processes */
    return statistics->stream != NULL ? HD_OK : fail_to_write(statistics, error);
}

HdStatus hd_statistics_add(HdStatistics *statistics, const HdScene *scene, const HdDevice *device,
                           const char *line, const HdStoredFrame *stored, HdError *error) {
    json_t *object = hd_statistics_line(&(HdStatisticsSource){scene, device, line, stored});
    if (object == NULL)
        return HD_NO_ROOM(error, "a line of statistics");
    bool can_write = hd_wait_to_write(fileno(statistics->stream));
    errno = can_write ? 0 : EINTR;
    bool failed =
        !can_write || json_dumpf(object, statistics->stream,
                                 JSON_COMPACT | JSON_REAL_PRECISION(SIGNIFICANT_DIGITS)) != 0;
    json_decref(object);
    if (failed || fputc('\n', statistics->stream) == EOF || fflush(statistics->stream) != 0)
        return fail_to_write(statistics, error);
    return HD_OK;
}

HdStatus hd_statistics_close(HdStatistics *statistics, HdDurability durability, HdStatus before,
                             HdError *error) {
    HdError ignored, *reported = before == HD_OK ? error : &ignored;
    if (statistics->stream == NULL || statistics->is_standard_output)
        return before;
    errno = 0;
    HdStatus status = fflush(statistics->stream) == 0 ? HD_OK : fail_to_write(statistics, reported);
    if (status == HD_OK && durability == HD_DURABLE)
        status = hd_sync_file(fileno(statistics->stream), statistics->name, reported);
    if (status == HD_OK && durability == HD_DURABLE)
        status = hd_sync_folder(statistics->name, reported);
    errno = 0;
    if (fclose(statistics->stream) != 0 && status == HD_OK)
        status = fail_to_write(statistics, reported);
    return before == HD_OK ? status : before;
}
