/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* processors */
#include "system/processor.h"

#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "system/machine.h"

/* ---- names of ARM's cores ---- */

enum { ARM = 0x41, CAVIUM = 0x43, FUJITSU = 0x46, HISILICON = 0x48, NVIDIA = 0x4e };
enum { QUALCOMM = 0x51, APPLE = 0x61, AMPERE = 0xc0 };

/* "CPU implementer" and "CPU part" of /proc/cpuinfo: fields of the register MIDR_EL1. */
typedef struct Core {
    int implementer, part;
    const char *name;
} Core;

static const Core cores[] = {
    {ARM, 0xc07, "Cortex-A7"},          {ARM, 0xc09, "Cortex-A9"},
    {ARM, 0xc0f, "Cortex-A15"},         {ARM, 0xc0e, "Cortex-A17"},
    {ARM, 0xd03, "Cortex-A53"},         {ARM, 0xd04, "Cortex-A35"},
    {ARM, 0xd05, "Cortex-A55"},         {ARM, 0xd07, "Cortex-A57"},
    {ARM, 0xd08, "Cortex-A72"},         {ARM, 0xd09, "Cortex-A73"},
    {ARM, 0xd0a, "Cortex-A75"},         {ARM, 0xd0b, "Cortex-A76"},
    {ARM, 0xd0c, "Neoverse N1"},        {ARM, 0xd0d, "Cortex-A77"},
    {ARM, 0xd40, "Neoverse V1"},        {ARM, 0xd41, "Cortex-A78"},
    {ARM, 0xd42, "Cortex-A78AE"},       {ARM, 0xd44, "Cortex-X1"},
    {ARM, 0xd46, "Cortex-A510"},        {ARM, 0xd47, "Cortex-A710"},
    {ARM, 0xd48, "Cortex-X2"},          {ARM, 0xd49, "Neoverse N2"},
    {ARM, 0xd4b, "Cortex-A78C"},        {ARM, 0xd4c, "Cortex-X1C"},
    {ARM, 0xd4d, "Cortex-A715"},        {ARM, 0xd4e, "Cortex-X3"},
    {ARM, 0xd4f, "Neoverse V2"},        {ARM, 0xd80, "Cortex-A520"},
    {ARM, 0xd81, "Cortex-A720"},        {ARM, 0xd82, "Cortex-X4"},
    {ARM, 0xd84, "Neoverse V3"},        {ARM, 0xd85, "Cortex-X925"},
    {ARM, 0xd87, "Cortex-A725"},        {ARM, 0xd8e, "Neoverse N3"},
    {CAVIUM, 0x0af, "ThunderX2"},       {FUJITSU, 0x001, "A64FX"},
    {HISILICON, 0xd01, "Kunpeng 920"},  {NVIDIA, 0x003, "Denver 2"},
    {NVIDIA, 0x004, "Carmel"},          {QUALCOMM, 0x001, "Oryon"},
    {QUALCOMM, 0x804, "Kryo 4xx Gold"}, {QUALCOMM, 0x805, "Kryo 4xx Silver"},
    {APPLE, 0x022, "Apple M1"},         {APPLE, 0x023, "Apple M1"},
    {APPLE, 0x024, "Apple M1 Pro"},     {APPLE, 0x025, "Apple M1 Pro"},
    {APPLE, 0x028, "Apple M1 Max"},     {APPLE, 0x029, "Apple M1 Max"},
    {APPLE, 0x032, "Apple M2"},         {APPLE, 0x033, "Apple M2"},
    {AMPERE, 0xac3, "Ampere-1"},        {AMPERE, 0xac4, "Ampere-1A"},
};

static void name_core(int implementer, int part, char *name, size_t capacity) {
    snprintf(name, capacity, "ARM core 0x%02x-0x%03x", implementer, part);
    for (size_t i = 0; i < sizeof cores / sizeof *cores; i++)
        if (cores[i].implementer == implementer && cores[i].part == part)
            snprintf(name, capacity, "%s", cores[i].name);
}

/* ---- what Linux reports ---- */

static FILE *open_below(const char *root, const char *path) {
    char whole[4096];
    snprintf(whole, sizeof whole, "%s%s", root, path);
    return fopen(whole, "r");
}

/* Appends a text to a list, unless it is there. */
static void append_once(char *list, size_t capacity, const char *text) {
    const size_t length = strlen(list);
    if (strstr(list, text) == NULL)
        snprintf(list + length, capacity - length, "%s%s", length > 0 ? ", " : "", text);
}

/* Returns the text after the colon of a line that begins with `key`, or NULL. */
static char *value_of(char *line, const char *key) {
    char *colon = strchr(line, ':');
    line[strcspn(line, "\n")] = '\0';
    return strncmp(line, key, strlen(key)) == 0 && colon != NULL && colon[1] != '\0' ? colon + 2
                                                                                     : NULL;
}

/* ARM's cores have names of their own; a model's name is there "ARMv7 Processor" or missing. */
static void read_cpuinfo(FILE *file, char *name, size_t capacity) {
    char line[512], model[512] = "", core[64];
    const char *value;
    int implementer = 0;
    while (fgets(line, sizeof line, file) != NULL) {
        if (model[0] == '\0' && (value = value_of(line, "model name")) != NULL)
            snprintf(model, sizeof model, "%s", value);
        else if ((value = value_of(line, "CPU implementer")) != NULL)
            implementer = (int)strtol(value, NULL, 0);
        else if ((value = value_of(line, "CPU part")) != NULL) {
            name_core(implementer, (int)strtol(value, NULL, 0), core, sizeof core);
            append_once(name, capacity, core);
        }
    }
    if (name[0] == '\0')
        snprintf(name, capacity, "%s", model);
}

/* Reads a file that may end with a null character, as those of device trees do. */
static void read_text(const char *root, const char *path, char *text, size_t capacity) {
    FILE *file = open_below(root, path);
    size_t length = 0;
    if (file != NULL) {
        length = fread(text, 1, capacity - 1, file);
        fclose(file);
    }
    text[length] = '\0';
}

void hd_processor_name(const char *root, char *name, size_t capacity) {
    char machine[128];
    name[0] = '\0';
    FILE *file = open_below(root, "/proc/cpuinfo");
    if (file != NULL) {
        read_cpuinfo(file, name, capacity);
        fclose(file);
    }
    read_text(root, "/proc/device-tree/model", machine, sizeof machine);
    const size_t length = strlen(name);
    if (machine[0] != '\0')
        snprintf(name + length, capacity - length, length > 0 ? " (%s)" : "%s", machine);
    else if (length == 0)
        snprintf(name, capacity, "processor");
}

/* Returns a core's capacity relative to others, 0 if Linux reports none. */
static int capacity_of(const char *root, int number) {
    char path[64], text[32];
    snprintf(path, sizeof path, "/sys/devices/system/cpu/cpu%d/cpu_capacity", number);
    read_text(root, path, text, sizeof text);
    return (int)strtol(text, NULL, 10);
}

HdCores hd_processor_cores(const char *root) {
    cpu_set_t set;
    HdCores found = {.big = hd_processor_count()};
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return found;
    int capacity[CPU_SETSIZE], count = 0, most = 0;
    for (int i = 0; i < CPU_SETSIZE; i++)
        if (CPU_ISSET((size_t)i, &set)) {
            capacity[count] = capacity_of(root, i);
            most = capacity[count] > most ? capacity[count] : most;
            count++;
        }
    for (int i = 0; i < count; i++)
        found.little += most > 0 && 2 * capacity[i] <= most;
    found.big -= found.little;
    return found;
}
