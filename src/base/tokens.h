/* SPDX-License-Identifier: MIT */
/* Reads a text of tokens separated by white space, with messages that name the line, the value and
   what was expected. After the first failure nothing is read any more, so a list of reads needs no
   checks in between. */
#ifndef HD_BASE_TOKENS_H
#define HD_BASE_TOKENS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

enum { HD_MAX_TOKEN = 4096 }; /* bytes of a token, with the zero byte */

typedef struct HdTokenReader {
    const char *text; /* need not end in a zero byte */
    size_t size, position;
    int line;          /* of the token read last; starts at 1 */
    const char *name;  /* of the text, for messages */
    bool hides_tokens; /* from messages: the text is somebody else's */
    char where[32];    /* put before the names of values: "solid 2: ", or nothing */
    HdError *error;
    HdStatus status;
} HdTokenReader;

/* `what` names the value in messages. `value` is left alone where there is none or a wrong one. */

/* A finite number in decimal notation. */
void hd_read_number(HdTokenReader *reader, const char *what, double *value);

/* A number from 0 to 1. */
void hd_read_share(HdTokenReader *reader, const char *what, double *value);

/* A whole number from `low` to `high`. */
void hd_read_int(HdTokenReader *reader, const char *what, int low, int high, int *value);

/* Any token, which names a file. */
void hd_read_path(HdTokenReader *reader, const char *what, char path[HD_MAX_TOKEN]);

/* Fails where a token is left. */
void hd_read_end(HdTokenReader *reader);

#endif
