/* SPDX-License-Identifier: MIT */
/* Turns a file into a C array at build time:

       embed SYMBOL OUTPUT.c INPUT [--flatten]

   With --flatten every #include "path" is replaced by that file's text, once, and #line directives
   name the files relative to the current folder, as INPUT is. An include must not depend on a
   surrounding #if: the text replaces the first occurrence. */
#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FILES = 256, MAX_PATH = 1024, MAX_INCLUDE_DEPTH = 32 };

typedef struct Text {
    char *bytes;
    size_t size, capacity;
} Text;

typedef struct Options {
    const char *symbol, *output, *input;
    bool flatten;
} Options;

typedef struct Job {
    Options options;
    char files[MAX_FILES][MAX_PATH]; /* files read so far, relative to the current folder */
    int file_count;
    Text result;
} Job;

#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 1, 2)))
#endif
static void
die(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("embed: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(1);
}

static void append(Text *text, const char *bytes, size_t size) {
    if (text->capacity - text->size < size) {
        size_t capacity = 2 * (text->capacity + size);
        char *grown = realloc(text->bytes, capacity);
        if (!grown)
            die("out of memory");
        text->bytes = grown;
        text->capacity = capacity;
    }
    if (size)
        memcpy(text->bytes + text->size, bytes, size);
    text->size += size;
}

static void join(char path[MAX_PATH], const char *folder, const char *name) {
    bool bare = !folder[0] || name[0] == '/';
    int length = snprintf(path, MAX_PATH, "%s%s%s", bare ? "" : folder, bare ? "" : "/", name);
    if (length < 0 || length >= MAX_PATH)
        die("a path is too long: %s", name);
}

static Text read_file(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file)
        die("cannot open %s: %s", path, strerror(errno));
    Text text = {0};
    char buffer[4096];
    size_t got;
    while ((got = fread(buffer, 1, sizeof buffer, file)) > 0)
        append(&text, buffer, got);
    if (ferror(file))
        die("cannot read %s", path);
    fclose(file);
    return text;
}

/* Removes "." and "..", so that a file has one name whichever way it is reached. */
static void normalise(char path[MAX_PATH]) {
    char result[MAX_PATH] = "";
    char *rest = path;
    while (*rest) {
        size_t length = strcspn(rest, "/");
        char *end = rest + length;
        bool last = !*end;
        *end = '\0';
        char *slash = strrchr(result, '/');
        bool climbs = strcmp(rest, "..") == 0;
        if (climbs && result[0] && strcmp(slash ? slash + 1 : result, "..") != 0) {
            *(slash ? slash : result) = '\0';
        } else if (length > 0 && strcmp(rest, ".") != 0) {
            if (result[0])
                strcat(result, "/");
            strcat(result, rest);
        }
        rest = last ? end : end + 1;
    }
    strcpy(path, result);
}

/* Reads the name between the quotes of a line that is #include "name". */
static bool quoted_include(const char *line, size_t length, char name[MAX_PATH]) {
    const char *end = line + length;
    const char *at = line;
    while (at < end && isblank((unsigned char)*at))
        at++;
    if (at == end || *at++ != '#')
        return false;
    while (at < end && isblank((unsigned char)*at))
        at++;
    static const char word[] = "include";
    if ((size_t)(end - at) < sizeof word - 1 || memcmp(at, word, sizeof word - 1) != 0)
        return false;
    at += sizeof word - 1;
    while (at < end && isblank((unsigned char)*at))
        at++;
    if (at == end || *at++ != '"')
        return false;
    const char *quote = memchr(at, '"', (size_t)(end - at));
    if (!quote || quote - at >= MAX_PATH)
        return false;
    memcpy(name, at, (size_t)(quote - at));
    name[quote - at] = '\0';
    return true;
}

static bool remember_file(Job *job, const char *name) {
    for (int i = 0; i < job->file_count; i++)
        if (strcmp(job->files[i], name) == 0)
            return false;
    if (job->file_count == MAX_FILES)
        die("more than %d files are included", (int)MAX_FILES);
    join(job->files[job->file_count++], "", name);
    return true;
}

static void append_line_directive(Job *job, int line, const char *name) {
    char directive[MAX_PATH + 32];
    int length = snprintf(directive, sizeof directive, "#line %d \"%s\"\n", line, name);
    append(&job->result, directive, (size_t)length);
}

static void flatten(Job *job, const char *name, int depth) {
    if (depth > MAX_INCLUDE_DEPTH)
        die("includes are nested too deep in %s", name);
    char folder[MAX_PATH];
    join(folder, "", name);
    char *slash = strrchr(folder, '/');
    *(slash ? slash : folder) = '\0';

    Text text = read_file(name);
    append_line_directive(job, 1, name);
    int number = 0;
    for (size_t at = 0; at < text.size;) {
        const char *line = text.bytes + at;
        const char *newline = memchr(line, '\n', text.size - at);
        size_t length = newline ? (size_t)(newline - line) : text.size - at;
        at += length + (newline ? 1 : 0);
        number++;
        char target[MAX_PATH], included[MAX_PATH];
        if (!quoted_include(line, length, target)) {
            append(&job->result, line, length);
            append(&job->result, "\n", 1);
            continue;
        }
        join(included, folder, target);
        normalise(included);
        if (remember_file(job, included)) {
            flatten(job, included, depth + 1);
            append_line_directive(job, number + 1, name);
        } else {
            append(&job->result, "\n", 1);
        }
    }
    free(text.bytes);
}

static FILE *create(const char *path) {
    FILE *file = fopen(path, "wb");
    if (!file)
        die("cannot create %s: %s", path, strerror(errno));
    return file;
}

static void finish(FILE *file, const char *path) {
    bool failed = ferror(file) != 0;
    failed = fclose(file) != 0 || failed;
    if (failed) {
        remove(path);
        die("cannot write %s", path);
    }
}

static void write_array(const Job *job) {
    const Options *options = &job->options;
    FILE *file = create(options->output);
    fprintf(file, "/* Made from %s when the program was built. */\n", options->input);
    fprintf(file, "#include <stddef.h>\n\nextern const unsigned char %s[];\n", options->symbol);
    fprintf(file, "extern const size_t %s_size;\n\nconst unsigned char %s[] = {\n", options->symbol,
            options->symbol);
    for (size_t i = 0; i < job->result.size; i++)
        fprintf(file, "%u,%s", (unsigned)(unsigned char)job->result.bytes[i],
                i % 24 == 23 ? "\n" : "");
    fprintf(file, "0};\nconst size_t %s_size = %zu;\n", options->symbol, job->result.size);
    finish(file, options->output);
}

static Options parse(int argc, char **argv) {
    Options options = {0};
    const char **positional[] = {&options.symbol, &options.output, &options.input};
    int count = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--flatten") == 0)
            options.flatten = true;
        else if (count < 3 && strncmp(argv[i], "--", 2) != 0)
            *positional[count++] = argv[i];
        else
            die("unexpected argument: %s", argv[i]);
    }
    if (count < 3)
        die("usage: embed SYMBOL OUTPUT.c INPUT [--flatten]");
    return options;
}

int main(int argc, char **argv) {
    static Job job;
    job.options = parse(argc, argv);
    remember_file(&job, job.options.input);
    if (job.options.flatten)
        flatten(&job, job.options.input, 0);
    else
        job.result = read_file(job.options.input);
    write_array(&job);
    free(job.result.bytes);
    return 0;
}
