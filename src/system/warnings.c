/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/warnings.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MAX_SENTENCES = 8 };

static char sentences[MAX_SENTENCES][HD_FALLBACK_LENGTH];
static int count;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static bool is_new(const char *text) {
    for (int i = 0; i < count; i++)
        if (strcmp(sentences[i], text) == 0)
            return false;
    return true;
}

void hd_fallback_note(const char *format, ...) {
    char text[HD_FALLBACK_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pthread_mutex_lock(&mutex);
    if (count < MAX_SENTENCES && is_new(text))
        memcpy(sentences[count++], text, sizeof text);
    pthread_mutex_unlock(&mutex);
}

bool hd_fallback_take(char text[HD_FALLBACK_LENGTH]) {
    pthread_mutex_lock(&mutex);
    bool found = count > 0;
    if (found) {
        memcpy(text, sentences[0], HD_FALLBACK_LENGTH);
        memmove(sentences[0], sentences[1], sizeof sentences - sizeof sentences[0]);
        count--;
    }
    pthread_mutex_unlock(&mutex);
    return found;
}
