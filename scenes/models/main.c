/* SPDX-License-Identifier: MIT */
/* Writes a model of the requested number of triangles; "hedron_model --help" explains it. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"
#include "system/atomic_file.h"
#include "system/interrupt.h"

static const HdModel *const models[] = {&hd_model_sphere, &hd_model_knot, &hd_model_soup};
enum { MODEL_COUNT = sizeof models / sizeof models[0] };

typedef struct Order {
    const HdModel *model;
    int triangles;
    const char *path; /* NULL: standard output */
} Order;

static HdStatus print_help(HdError *error) {
    printf(
        "Usage: hedron_model KIND TRIANGLES [-o FILE.obj]\n\n"
        "Writes a model as Wavefront OBJ, to standard output unless a file is named. KIND is:\n\n");
    for (int i = 0; i < MODEL_COUNT; i++)
        printf("  %-8s%s\n", models[i]->name, models[i]->summary);
    printf(
        "\nTRIANGLES, from %d to %d, is reached as closely as the model's grid allows; the shape\n"
        "does not depend on it. The first line of the output says how many there are.\n\n"
        "Exit codes: 0 done, 1 failed, 2 wrong usage, 130 and 143 interrupted.\n",
        HD_MODEL_LEAST, HD_MODEL_MOST);
    if (fflush(stdout) == 0)
        return HD_OK;
    return hd_fail(error, HD_FAILED, "cannot write to standard output: %s", strerror(errno));
}

static HdStatus find_model(const char *name, const HdModel **model, HdError *error) {
    for (int i = 0; i < MODEL_COUNT; i++) {
        if (strcmp(models[i]->name, name) == 0) {
            *model = models[i];
            return HD_OK;
        }
    }
    return hd_fail(error, HD_BAD_INPUT,
                   "\"%s\" is an unknown kind, expected \"sphere\", \"knot\" or \"soup\"", name);
}

static HdStatus read_triangles(const char *text, int *triangles, HdError *error) {
    size_t length = strlen(text);
    bool is_number = length > 0 && length <= 9 && strspn(text, "0123456789") == length;
    *triangles = is_number ? (int)strtol(text, NULL, 10) : 0;
    if (*triangles >= HD_MODEL_LEAST && *triangles <= HD_MODEL_MOST)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT,
                   "TRIANGLES is \"%s\", expected a whole number from %d to %d", text,
                   HD_MODEL_LEAST, HD_MODEL_MOST);
}

/* Parses the arguments after the program's name. */
static HdStatus parse(char **arguments, Order *order, HdError *error) {
    const char *operands[2];
    int count = 0;
    memset(order, 0, sizeof *order);
    for (; *arguments != NULL; arguments++) {
        if (strcmp(*arguments, "-o") == 0 && arguments[1] != NULL && order->path == NULL)
            order->path = *++arguments;
        else if (strcmp(*arguments, "-o") == 0)
            return hd_fail(error, HD_BAD_INPUT, "expected the name of one file after -o");
        else if ((*arguments)[0] == '-')
            return hd_fail(error, HD_BAD_INPUT, "%s is an unknown option; --help lists all",
                           *arguments);
        else if (count == 2)
            return hd_fail(error, HD_BAD_INPUT, "\"%s\" is too much; --help tells what is expected",
                           *arguments);
        else
            operands[count++] = *arguments;
    }
    if (count < 2)
        return hd_fail(error, HD_BAD_INPUT, "expected KIND and TRIANGLES; --help explains them");
    HdStatus status = find_model(operands[0], &order->model, error);
    return status != HD_OK ? status : read_triangles(operands[1], &order->triangles, error);
}

static HdStatus write_model(const Order *order, FILE *stream, HdError *error) {
    static HdObjWriter writer;
    char comment[128];
    hd_obj_begin(&writer, stream);
    snprintf(comment, sizeof comment, "%s: %d triangles; hedron_model %s %d", order->model->summary,
             order->model->triangles(order->triangles), order->model->name, order->triangles);
    hd_obj_comment(&writer, comment);
    order->model->write(&writer, order->triangles);
    hd_obj_end(&writer);
    if (!writer.failed)
        return HD_OK;
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted");
    return hd_fail(error, HD_FAILED, "cannot write %s: %s",
                   order->path == NULL ? "to standard output" : order->path,
                   strerror(writer.reason));
}

static HdStatus run(char **arguments, HdError *error) {
    Order order;
    HdAtomicFile file;
    HdStatus status = parse(arguments, &order, error);
    if (status == HD_OK && order.path == NULL)
        return write_model(&order, stdout, error);
    if (status == HD_OK)
        status = hd_atomic_file_open(&file, order.path, error);
    if (status != HD_OK)
        return status;
    status = write_model(&order, file.stream, error);
    if (status == HD_OK)
        return hd_atomic_file_commit(&file, HD_DURABLE, error);
    hd_atomic_file_discard(&file);
    return status;
}

int main(int count, char **arguments) {
    static HdError error;
    hd_interrupt_install();
    bool asks_for_help = count == 2 && strcmp(arguments[1], "--help") == 0;
    HdStatus status = hd_interrupt_read_timeout(&error);
    if (status == HD_OK)
        status = asks_for_help ? print_help(&error) : run(arguments + 1, &error);
    if (status == HD_OK)
        return 0;
    fprintf(stderr, "hedron_model: %s\n", error.message);
    return status == HD_INTERRUPTED ? 128 + hd_interrupt_signal() : (int)status;
}
