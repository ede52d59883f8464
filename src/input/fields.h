/* SPDX-License-Identifier: MIT */
/* The table of all scene fields. The reader, the writer, the checks, the JSON Schema and the
   messages' expectations follow it. */
#ifndef HD_INPUT_FIELDS_H
#define HD_INPUT_FIELDS_H

#include <stdbool.h>
#include <stddef.h>

#include "input/scene_file.h"

enum {
    HD_MAX_MATERIALS = 1024,
    HD_EXPECTED_SIZE = 256,
    HD_FIELD_NAME_SIZE = 48,
    HD_DESCRIPTION_SIZE = 512
};

/* Key of a comment for people, valid in every object. */
#define HD_COMMENT_KEY "$comment"

/* A field's JSON type and the C type at its offset. */
typedef enum HdFieldType {
    HD_FIELD_BOOLEAN,  /* bool */
    HD_FIELD_INTEGER,  /* int */
    HD_FIELD_NUMBER,   /* double */
    HD_FIELD_VECTOR,   /* [x, y, z]; HdVec3 */
    HD_FIELD_UNSCALED, /* vector without its factor, the next field with the same offset; */
    HD_FIELD_FACTOR,   /* number */
    HD_FIELD_VECTORS,  /* array of vectors; HdVec3[most], and their number if it varies */
    HD_FIELD_CHOICE,   /* one of `choices`; int or an enum */
    HD_FIELD_RATE,     /* integer n, or "n000/1001"; HdOutputStyle */
    HD_FIELD_SCALE,    /* number, or a vector; HdVec3 */
    HD_FIELD_TEXT,     /* string; char[HD_MAX_PATH], empty if absent */
    HD_FIELD_FILE,     /* string, a path relative to the scene's folder; char *, owned */
    HD_FIELD_MATERIAL, /* name of a material; HdMaterial */
    HD_FIELD_PATH,     /* [x, y, z] or `object`; HdPath */
    HD_FIELD_OBJECT,   /* `object`; that struct */
    HD_FIELD_LIST,     /* array of `object`; pointer to that struct, and the number of them */
    HD_FIELD_MATERIALS /* one `object` for each name; not stored in the scene */
} HdFieldType;

typedef struct HdChoice {
    const char *word; /* a number in JSON if it begins with a digit; NULL ends a list */
    int value;
} HdChoice;

typedef struct HdObjectType HdObjectType;

typedef struct HdField {
    const char *key;
    const char *about; /* effect, without a full stop; for help, schema and reference */
    HdFieldType type;
    bool required;
    bool above_low, below_high; /* the bound itself is out of range */
    double low, high;           /* range of the number, or of each component of a vector */
    bool has_sign;              /* the range is that of the absolute value */
    double least_but_zero;      /* least value besides 0 in a valid scene; 0: no such limit */
    bool is_unseen;             /* does not affect pixels */
    bool is_light;              /* vectors are red, green and blue, not x, y and z */
    const char *name, *unit;    /* name in the checks (NULL: its key); unit (NULL: none) */
    const char *measure;        /* unit of its numbers, or their space; NULL: none */
    const char *example;        /* value in JSON, for the reference; NULL: none */
    double standard[3];         /* default; of a required field a valid stand-in */
    size_t offset;              /* offset in the struct of the field's object */
    size_t count_offset;        /* offset of the element count; 0: always `most` */
    int least, most;            /* minimum and maximum number of elements */
    const HdChoice *choices;
    const HdObjectType *object;
    size_t flag_offset;     /* offset of the bool that says if it is given; 0: none */
    const char *instead_of; /* key that excludes this one */
    bool zero_is_absent;    /* absent means 0 in the scene */
    /* Returns whether the scene has an optional object. NULL: it always has, and a missing object
       reads as an empty one. */
    bool (*is_given)(const void *owner);
} HdField;

struct HdObjectType {
    const HdField *fields;
    int field_count;
    size_t size;      /* size of the struct */
    bool is_complete; /* the writer omits no default */
    const char *note; /* rules between its keys, for help and reference; NULL: none */
};

/* Fields of the whole file; the struct is HdSceneFile. */
extern const HdObjectType hd_scene_fields;

/* Fields of a material; the struct is HdMaterial. */
extern const HdObjectType hd_material_fields;

/* Finds the field of a key, or returns NULL. */
const HdField *hd_field(const HdObjectType *type, const char *key);

/* Returns whether the field may be absent rather than default. */
bool hd_field_may_be_absent(const HdField *field);

/* Returns whether the struct at `owner` has the field. */
bool hd_field_is_given(const HdField *field, const void *owner);

/* Writes the field's name in the checks: "mirror tint". */
void hd_field_name(const HdField *field, char out[HD_FIELD_NAME_SIZE]);

/* Returns whether the word is a number. */
bool hd_choice_is_number(const char *word);

/* Returns the word of the value's choice, or the last one if no choice has the value. */
const char *hd_field_choice(const HdField *field, int value);

/* Returns the number of list elements, or of vectors, in the struct at `owner`. */
int hd_field_count(const HdField *field, const void *owner);

/* Returns whether the number is in the field's range. */
bool hd_field_holds(const HdField *field, double value);

/* Writes its effect and its unit: "Horizontal field of view (degrees)". */
void hd_field_describe(const HdField *field, char out[HD_DESCRIPTION_SIZE]);

/* Returns the number of numbers in the field: 3 for vectors, 1, or 0. */
int hd_field_parts(const HdField *field);

/* Stores numbers in the struct at `owner`. Vectors, a path's point and a single one of several
   vectors have three; others have one, which may be a choice's value or 0 for false. Fields without
   numbers keep their value. A factor multiplies the stored value. */
void hd_field_set(const HdField *field, void *owner, const double numbers[3]);

/* Writes the expected value, as "a number above 0 and at most 1e6"; with 1 or 3 `parts` that of one
   number or vector of the field. */
void hd_field_expected(const HdField *field, int parts, char out[HD_EXPECTED_SIZE]);

/* Writes the expected element count of a list, as "1 to 30 elements". */
void hd_field_expected_count(const HdField *field, char out[HD_EXPECTED_SIZE]);

#endif
