/* SPDX-License-Identifier: MIT */
/* The one table of what a scene may say. The reader, the writer, the checks and the JSON Schema
   follow it, and so does what messages expect. */
#ifndef HD_INPUT_FIELDS_H
#define HD_INPUT_FIELDS_H

#include <stdbool.h>
#include <stddef.h>

#include "input/scene_file.h"

enum {
    HD_MAX_MATERIALS = 1024,
    HD_EXPECTED_SIZE = 256,
    HD_SAID_SIZE = 48,
    HD_DESCRIPTION_SIZE = 512
};

/* The key that every object may have, with a text for people. */
#define HD_COMMENT_KEY "$comment"

/* What a field is in JSON, and in the struct at its offset. */
typedef enum HdFieldType {
    HD_FIELD_BOOLEAN,  /* bool */
    HD_FIELD_INTEGER,  /* int */
    HD_FIELD_NUMBER,   /* double */
    HD_FIELD_VECTOR,   /* [x, y, z]; HdVec3 */
    HD_FIELD_UNSCALED, /* the same, but for the factor of the next field, which has its offset; */
    HD_FIELD_FACTOR,   /* number */
    HD_FIELD_VECTORS,  /* array of vectors; HdVec3[most], and their number if that may vary */
    HD_FIELD_CHOICE,   /* one of `choices`; int or an enum */
    HD_FIELD_SCALE,    /* number, or a vector; HdVec3 */
    HD_FIELD_TEXT,     /* string; char[HD_MAX_PATH], empty where it is not given */
    HD_FIELD_FILE,     /* string, a path that counts from the scene's folder; char *, owned */
    HD_FIELD_MATERIAL, /* name of a material; HdMaterial */
    HD_FIELD_PATH,     /* [x, y, z] or `object`; HdPath */
    HD_FIELD_OBJECT,   /* `object`; that struct */
    HD_FIELD_LIST,     /* array of `object`; pointer to that struct, and the number of them */
    HD_FIELD_MATERIALS /* one `object` for each name; the scene has no place for them */
} HdFieldType;

typedef struct HdChoice {
    const char *word; /* in JSON a number where it begins with a digit; NULL ends a list */
    int value;
} HdChoice;

typedef struct HdObjectType HdObjectType;

typedef struct HdField {
    const char *key;
    const char *about; /* effect, without a full stop; for help, schema and reference */
    HdFieldType type;
    bool required;
    bool above_low, below_high; /* that bound itself is out of the range */
    double low, high;           /* of the number, or of every number of a vector */
    double least_but_zero;      /* a valid scene's number is 0 or at least this; 0: as above */
    bool is_unseen;             /* says nothing of what pixels look like */
    bool is_light;              /* vectors are red, green and blue, not x, y and z */
    const char *said, *unit;    /* how the checks call it (NULL: its key) and end (NULL: not) */
    const char *measure;        /* unit of its numbers, or their space; NULL: none */
    const char *example;        /* value in JSON, for the reference; NULL: none */
    double standard[3];         /* the default; where it is required, a valid stand-in */
    size_t offset;              /* in the struct of the object that the field belongs to */
    size_t count_offset;        /* of the number of elements; 0: `most`, always */
    int least, most;            /* elements */
    const HdChoice *choices;
    const HdObjectType *object;
    size_t flag_offset;     /* of a bool that tells whether it is given; 0: there is none */
    const char *instead_of; /* key that must not be given beside this one */
    bool zero_is_absent;    /* the scene has 0 where this number is not given */
    /* Whether the scene has what may be missing; NULL: it always does, and a missing object reads
       as an empty one. */
    bool (*is_given)(const void *owner);
} HdField;

struct HdObjectType {
    const HdField *fields;
    int field_count;
    size_t size;      /* of the struct */
    bool is_complete; /* the writer leaves out no default */
    const char *note; /* rules between its keys, for help and reference; NULL: none */
};

/* The whole file; its struct is HdSceneFile. */
extern const HdObjectType hd_scene_fields;

/* The scene's materials; the struct is HdMaterial. */
extern const HdObjectType hd_material_fields;

/* NULL where there is no such key. */
const HdField *hd_field(const HdObjectType *type, const char *key);

/* Whether a scene may lack the field rather than have its default. */
bool hd_field_may_be_absent(const HdField *field);

/* Whether the struct at `owner` has it. */
bool hd_field_is_given(const HdField *field, const void *owner);

/* What the checks call it: "mirror tint". */
void hd_field_said(const HdField *field, char out[HD_SAID_SIZE]);

/* Whether the word is a number. */
bool hd_choice_is_number(const char *word);

/* The word of the choice that has the value; of the last one where none has. */
const char *hd_field_choice(const HdField *field, int value);

/* Elements of its list, or vectors, in the struct at `owner`. */
int hd_field_count(const HdField *field, const void *owner);

/* Whether the number is in the field's range. */
bool hd_field_holds(const HdField *field, double value);

/* Writes its effect and its unit: "Horizontal field of view (degrees)". */
void hd_field_describe(const HdField *field, char out[HD_DESCRIPTION_SIZE]);

/* How many numbers it has: 3 as a vector or more of them, 1, or 0. */
int hd_field_parts(const HdField *field);

/* Puts numbers into the struct at `owner`: three of a vector, a path's point or the only one of
   several vectors, else one, which is a choice's value or 0 for false. What has no numbers
   stays. A factor is multiplied with what is there. */
void hd_field_set(const HdField *field, void *owner, const double numbers[3]);

/* What may stand there, as "a number above 0 and at most 1e6"; with 1 or 3 `parts` not as a whole,
   but for one of its numbers or vectors. */
void hd_field_expected(const HdField *field, int parts, char out[HD_EXPECTED_SIZE]);

/* The same for the number of elements of a list, as "1 to 30 elements". */
void hd_field_expected_count(const HdField *field, char out[HD_EXPECTED_SIZE]);

#endif
