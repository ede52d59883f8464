/* SPDX-License-Identifier: MIT */
/* Runs the unit tests: each file's in a process of its own, which may change its folder, its
   environment and its signals. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "unit_test.h"
#include "wrapped.h"

enum { MAX_FILES = 200, MAX_TESTS = 100, MAX_STARTS = 16, MAX_PROGRAMS = 8 };
enum { PASSED = 42 }; /* the exit code of a file's process, different from a stray exit(0) */

typedef struct File {
    const char *path;
    char name[200]; /* of tests/unit/system/test_path.c: "system/path" */
    struct CMUnitTest tests[MAX_TESTS];
    bool has_own_fixture[MAX_TESTS];
    int test_count, start_count;
    void (*starts[MAX_STARTS])(void);
    UnitFixture group_setup, group_teardown, setup, teardown;
} File;

static File files[MAX_FILES];
static int file_count;
static struct {
    const char *name;
    int (*program)(void);
} programs[MAX_PROGRAMS];
static int program_count;

const char *unit_project, *unit_program;

static void refuse(const char *what) {
    fprintf(stderr, "unit tests: %s\n", what);
    abort();
}

/* ---- registration, before main ---- */

static File *file_of(const char *path) {
    for (int i = 0; i < file_count; i++)
        if (strcmp(files[i].path, path) == 0)
            return &files[i];
    if (file_count == MAX_FILES)
        refuse("too many files");
    File *file = &files[file_count++];
    const char *name = strstr(path, "tests/unit/");
    name = name != NULL ? name + strlen("tests/unit/") : path;
    const char *stem = strstr(name, "test_");
    if (stem == NULL)
        refuse("files without test_ in their name");
    stem += strlen("test_");
    file->path = path;
    snprintf(file->name, sizeof file->name, "%.*s%.*s", (int)(stem - name - 5), name,
             (int)(strlen(stem) - 2), stem);
    return file;
}

void unit_add_test(const char *path, const char *name, CMUnitTestFunction test, UnitFixture setup,
                   UnitFixture teardown) {
    File *file = file_of(path);
    if (file->test_count == MAX_TESTS)
        refuse("too many tests in a file");
    file->has_own_fixture[file->test_count] = setup != NULL || teardown != NULL;
    file->tests[file->test_count++] = (struct CMUnitTest){
        .name = name, .test_func = test, .setup_func = setup, .teardown_func = teardown};
}

void unit_set_group(const char *path, UnitFixture setup, UnitFixture teardown) {
    File *file = file_of(path);
    file->group_setup = setup;
    file->group_teardown = teardown;
}

void unit_set_each(const char *path, UnitFixture setup, UnitFixture teardown) {
    File *file = file_of(path);
    file->setup = setup;
    file->teardown = teardown;
}

void unit_add_start(const char *path, void (*start)(void)) {
    File *file = file_of(path);
    if (file->start_count == MAX_STARTS)
        refuse("too many starts in a file");
    file->starts[file->start_count++] = start;
}

void unit_add_program(const char *name, int (*program)(void)) {
    if (program_count == MAX_PROGRAMS)
        refuse("too many programs");
    programs[program_count].name = name;
    programs[program_count++].program = program;
}

/* ---- running ---- */

typedef struct Timed {
    const struct CMUnitTest *test;
    const char *file;
    void *state;
    double begin_seconds;
} Timed;

static FILE *report; /* standard output, unless it is the tests' */

static int set_up(void **state) {
    Timed *timed = *state;
    timed->begin_seconds = real_hd_monotonic_seconds(); /* never replaced by a test */
    return timed->test->setup_func != NULL ? timed->test->setup_func(&timed->state) : 0;
}

static void call(void **state) {
    Timed *timed = *state;
    timed->test->test_func(&timed->state);
}

static int tear_down(void **state) {
    Timed *timed = *state;
    fprintf(report, "%8.3f s  %s %s\n", real_hd_monotonic_seconds() - timed->begin_seconds,
            timed->file, timed->test->name);
    fflush(report);
    return timed->test->teardown_func != NULL ? timed->test->teardown_func(&timed->state) : 0;
}

/* Shows the output of cmocka and the tests of a file, after a failure. */
static void show(int log_file) {
    char bytes[4096];
    ssize_t size;
    lseek(log_file, 0, SEEK_SET);
    while ((size = read(log_file, bytes, sizeof bytes)) > 0)
        fwrite(bytes, 1, (size_t)size, stdout);
    fflush(stdout);
}

static void show_skipped(int log_file) {
    char line[512];
    lseek(log_file, 0, SEEK_SET);
    FILE *lines = fdopen(dup(log_file), "r");
    while (lines != NULL && fgets(line, sizeof line, lines) != NULL)
        if (strncmp(line, "[  SKIPPED ] ", 13) == 0 && strstr(line, "test(s)") == NULL)
            printf("  skipped   %s", line + 13);
    if (lines != NULL)
        fclose(lines);
}

static bool is_wanted(const File *file, const char *test, int count, char **filters) {
    char name[400];
    snprintf(name, sizeof name, "%s %s", file->name, test);
    for (int i = 0; i < count; i++)
        if (strstr(name, filters[i]) != NULL)
            return true;
    return count == 0;
}

static int run_chosen(File *file, int count, char **filters) {
    static struct CMUnitTest tests[MAX_TESTS];
    static Timed timed[MAX_TESTS];
    size_t wanted = 0;
    for (int i = 0; i < file->test_count; i++) {
        struct CMUnitTest *test = &file->tests[i];
        if (!file->has_own_fixture[i]) {
            test->setup_func = file->setup;
            test->teardown_func = file->teardown;
        }
        if (!is_wanted(file, test->name, count, filters))
            continue;
        timed[wanted] = (Timed){.test = test, .file = file->name};
        tests[wanted] = (struct CMUnitTest){.name = test->name,
                                            .test_func = call,
                                            .setup_func = set_up,
                                            .teardown_func = tear_down,
                                            .initial_state = &timed[wanted]};
        wanted++;
    }
    for (int i = 0; i < file->start_count; i++)
        file->starts[i]();
    return _cmocka_run_group_tests(file->name, tests, wanted, file->group_setup,
                                   file->group_teardown);
}

/* Returns whether the tests of the file pass. */
static bool run_file(File *file, int count, char **filters) {
    int status = 0;
    const int log_file = memfd_create("log", 0);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        report = fdopen(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 100), "w");
        dup2(log_file, STDOUT_FILENO);
        dup2(log_file, STDERR_FILENO);
        close(log_file);
        exit(run_chosen(file, count, filters) == 0 ? PASSED : 1);
    }
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    const bool passed = child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == PASSED;
    if (!passed) {
        show(log_file);
        if (WIFSIGNALED(status))
            printf("ended by signal %d (%s)\n", WTERMSIG(status), strsignal(WTERMSIG(status)));
        printf("FAILED      %s; alone: ./dev test %s\n", file->name, file->name);
    } else {
        show_skipped(log_file);
    }
    close(log_file);
    return passed;
}

static int by_name(const void *a, const void *b) {
    return strcmp(((const File *)a)->name, ((const File *)b)->name);
}

static bool has_wanted(const File *file, int count, char **filters) {
    for (int i = 0; i < file->test_count; i++)
        if (is_wanted(file, file->tests[i].name, count, filters))
            return true;
    return false;
}

int main(int count, char **arguments) {
    static char self[PATH_MAX];
    int ran = 0, failed = 0;
    const char *name = strrchr(arguments[0], '/');
    name = name != NULL ? name + 1 : arguments[0];
    for (int i = 0; i < program_count; i++)
        if (strcmp(programs[i].name, name) == 0 ||
            (count > 1 && strcmp(programs[i].name, arguments[1]) == 0))
            return programs[i].program();
    if (count < 2 || realpath("/proc/self/exe", self) == NULL ||
        (unit_project = realpath(arguments[1], NULL)) == NULL) {
        fprintf(
            stderr,
            "usage: %s PROJECT_FOLDER [PART...]\n"
            "Runs the unit tests in whose names (\"FOLDER/FILE TEST\") one of the parts occurs.\n",
            name);
        return 2;
    }
    unit_program = self;
    qsort(files, (size_t)file_count, sizeof *files, by_name);
    for (int i = 0; i < file_count; i++) {
        if (!has_wanted(&files[i], count - 2, arguments + 2))
            continue;
        ran++;
        failed += !run_file(&files[i], count - 2, arguments + 2);
    }
    if (ran == 0)
        fprintf(stderr, "there are no such tests\n");
    return ran > 0 && failed == 0 ? 0 : 1;
}
