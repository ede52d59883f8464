/* SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "cli/option_values.h"
#include "cli/options.h"
#include "device/renderer.h"
#include "unit_test.h"

enum { MAX_ARGUMENTS = 200 };

static HdOptions options;
static HdError error;

/* Parses words that are separated by spaces; the texts live until the next call. */
static HdStatus parse(const char *line) {
    static char text[4096];
    static char *arguments[MAX_ARGUMENTS + 1];
    int count = 0;
    strcpy(text, line);
    for (char *word = strtok(text, " "); word != NULL; word = strtok(NULL, " ")) {
        assert_true(count < MAX_ARGUMENTS);
        arguments[count++] = word;
    }
    arguments[count] = NULL;
    error.message[0] = '\0';
    return hd_options_parse(&options, count, arguments, &error);
}

static void expect_parsed(const char *line) {
    if (parse(line) != HD_OK)
        fail_msg("'%s': %s", line, error.message);
}

static void check_refused(const char *line, const char *part) {
    if (parse(line) != HD_BAD_INPUT)
        fail_msg("'%s' is not refused", line);
    expect_contains(error.message, part);
    if (strchr(error.message, '\n') != NULL)
        fail_msg("'%s' has more than one line", error.message);
}

TEST(wrong_lines_are_refused) {
    static const char *const lines[][2] = {
        {"compare", "needs the names of two pictures"},
        {"compare a", "needs the names of two pictures"},
        {"compare a b c", "takes two names only, but 'c' came after 'b'"},
        {"compare a b --fail-above 256", "expected a number from 0 to 255"},
        {"compare a b --fail-above -1", "expected a number from 0 to 255"},
        {"compare a b --fail-above nan", "expected a number from 0 to 255"},
        {"compare a b --diff d.pfm", "expected a name that ends in .png"},
        {"compare a b --curve sRGB", "expected linear or srgb"},
        {"compare a b --size 1x1", "--size does not belong to 'hedron compare'"},
        {"render --diff d.png", "--diff does not belong to 'hedron render'"},
        {"--set a=1", "--set does not belong to the classic mode"},
        {"convert -o a.json -o b.json", "at most 1"},
        {"render --set abc", "PATH=VALUE"},
        {"render --set =3", "PATH=VALUE"},
        {"render --set", "needs a value"},
        {"render --layers depth,depth", "--layers has depth twice"},
        {"render --layers depth,dep", "--layers has 'dep', expected some of "},
        /* opposites */
        {"render --quiet --verbose", "only one of --verbose and --quiet"},
        {"--verbose --quiet", "only one of --verbose and --quiet"},
        {"--cpu --gpu", "only one of --gpu, --cpu and --default"},
        /* the nearest word, of which options of other commands are none */
        {"rendr", "did you mean 'hedron render'?"},
        {"xyzzy", "see 'hedron help'"},
        {"foo.json", "did you mean 'hedron render foo.json'?"},
        {"dir/foo.JSON --size 1x1", "did you mean 'hedron render dir/foo.JSON'?"},
        {"render --smples 3", "did you mean '--samples'?"},
        {"render --siz=3x3", "'--siz=3x3'; did you mean '--size'?"},
        {"render --frobnicate", "see 'hedron help render'"},
        {"devices --siz", "see 'hedron help devices'"},
        {"help mann", "did you mean 'hedron help man'?"},
        {"help chek", "did you mean 'hedron help check'?"},
        {"help x", "see 'hedron help help'"},
        /* too few and too many names */
        {"help man page", "takes one name only"},
        {"check", "needs the name of a scene"},
        {"check --schema a.json", "looks at no scene"},
        {"render a.json b.json", "'b.json' came after 'a.json'"},
        {"devices c", "takes options only, but 'c'"},
        {"--stats -", "expected a file"},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[128];
        snprintf(line, sizeof line, "hedron %s", lines[i][0]);
        check_refused(line, lines[i][1]);
    }
}

TEST(nothing_is_the_classic_mode) {
    expect_parsed("hedron");
    assert_int_equal(options.command, HD_COMMAND_CLASSIC);
    assert_int_equal(options.variant, 4);
    assert_int_equal(options.size.width, 0);
    assert_true(options.cutoff == -1.0);
    assert_int_equal(options.operand_count, 0);
    assert_false(options.quiet || options.verbose);
}

TEST(comparisons_take_two_pictures) {
    expect_parsed("hedron compare a.png b.pfm");
    assert_int_equal(options.command, HD_COMMAND_COMPARE);
    assert_string_equal(options.operands[1], "b.pfm");
    assert_true(options.fail_above == -1.0);
    assert_false(options.json || options.curve >= 0);
    assert_null(options.diff);
    expect_parsed("hedron compare --json a --diff d.PNG b --fail-above .5 --curve=linear");
    assert_true(options.json && options.fail_above == 0.5);
    assert_int_equal(options.curve, HD_CURVE_LINEAR);
    assert_string_equal(options.diff, "d.PNG");
    expect_parsed("hedron compare a b --curve srgb --fail-above 255");
    assert_int_equal(options.curve, HD_CURVE_SRGB);
}

TEST(operands_and_options_mix) {
    expect_parsed("hedron check --schema");
    expect_parsed("hedron check a.json b.json c.json");
    assert_int_equal(options.operand_count, 3);
    assert_string_equal(options.operands[2], "c.json");
    expect_parsed("hedron render --size 3x4 scene.json -o a.png --depth=2 -o b.gif");
    assert_int_equal(options.operand_count, 1);
    assert_string_equal(options.operands[0], "scene.json");
    assert_int_equal(options.output_count, 2);
    assert_string_equal(options.outputs[0], "a.png");
    assert_string_equal(options.outputs[1], "b.gif");
    assert_int_equal(options.size.height, 4);
    assert_int_equal(options.depth, 2);
    expect_parsed("hedron render --set a=b=c --set d=");
    assert_string_equal(options.changes[0], "a=b=c");
}

/* A line with so many repetitions of an option. */
static const char *repeated(const char *option, int count) {
    static char line[4096];
    strcpy(line, "hedron render");
    for (int i = 0; i < count; i++) {
        strcat(line, " ");
        strcat(line, option);
    }
    return line;
}

TEST(repetitions_have_a_limit) {
    expect_parsed(repeated("--output=a.png", 8));
    assert_int_equal(options.output_count, 8);
    check_refused(repeated("--output=a.png", 9), "at most 8");
    expect_parsed(repeated("--set=a.b=1", 64));
    assert_int_equal(options.change_count, 64);
    assert_string_equal(options.changes[63], "a.b=1");
    check_refused(repeated("--set=a.b=1", 65), "at most 64");
    expect_parsed(repeated("--quiet", 2));
    assert_true(options.quiet && !options.verbose);
}

TEST(help_has_topics) {
    static const struct {
        const char *line;
        HdCommand command;
        int form;
    } lines[] = {{"hedron help man", HD_COMMAND_CLASSIC, HD_HELP_MAN},
                 {"hedron help completion", HD_COMMAND_CLASSIC, HD_HELP_BASH},
                 {"hedron check -h", HD_COMMAND_CHECK, HD_HELP_TEXT},
                 {"hedron check --help", HD_COMMAND_CHECK, HD_HELP_TEXT},
                 {"hedron help --help", HD_COMMAND_HELP, HD_HELP_TEXT}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        expect_parsed(lines[i].line);
        assert_int_equal(options.command, HD_COMMAND_HELP);
        assert_int_equal(options.help_topic.command, lines[i].command);
        assert_int_equal(options.help_topic.form, lines[i].form);
    }
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        const HdCommandSpec *spec = &hd_command_specs[i];
        char line[64];
        assert_ptr_equal(hd_command_spec(spec->command), spec);
        snprintf(line, sizeof line, "hedron help %s", spec->name != NULL ? spec->name : "");
        expect_parsed(line);
        assert_int_equal(options.help_topic.form, HD_HELP_TEXT);
        assert_int_equal(options.help_topic.command, spec->command);
    }
}

TEST(choices_are_words_of_a_list) {
    static const char *const four[] = {"auto", "c", "opencl", "cuda", NULL};
    static const char *const one[] = {"one", NULL};
    char text[64];
    assert_int_equal(hd_option_choice(four, "auto"), 0);
    assert_int_equal(hd_option_choice(four, "cuda"), 3);
    assert_int_equal(hd_option_choice(four, ""), -1);
    assert_int_equal(hd_option_choice(four, "cud"), -1);
    assert_int_equal(hd_option_choice(four, "c opencl"), -1);
    hd_option_list_choices(four, text, sizeof text);
    assert_string_equal(text, "auto, c, opencl or cuda");
    hd_option_list_choices(one, text, sizeof text);
    assert_string_equal(text, "one");
    hd_option_list_choices(four, text, 8);
    assert_string_equal(text, "auto, c");
}

TEST(every_backend_can_be_chosen) {
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++)
        for (int j = 0; strcmp(spec->name, "--backend") == 0 && j < HD_BACKEND_COUNT; j++)
            assert_true(hd_option_choice(spec->choices, hd_backends[j]->name) > 0);
}

/* Each value reaches its own member. */
TEST(values_reach_their_members) {
    expect_parsed("hedron render --samples 3 --depth 5 --cutoff .25 --aa adaptive "
                  "--max-error 2 --crop 1x2+3+4 --size 6X7 --geometry triangles "
                  "--divisions 8 --accel bvh --frames 0-9 --device c:0 --stats - "
                  "--again --frame-lines --verbose");
    const HdOptionCrop *crop = &options.crop;
    assert_true(options.samples == 3 && options.depth == 5 && options.divisions == 8);
    assert_true(options.cutoff == 0.25 && options.max_error == 2.0);
    assert_int_equal(options.sampling, HD_SAMPLING_ADAPTIVE);
    assert_true(crop->width == 1 && crop->height == 2 && crop->left == 3 && crop->top == 4);
    assert_true(options.size.width == 6 && options.size.height == 7);
    assert_int_equal(options.geometry, HD_GEOMETRY_TRIANGLES);
    assert_int_equal(options.accel, HD_ACCEL_BVH);
    assert_string_equal(options.frames, "0-9");
    assert_string_equal(options.device, "c:0");
    assert_string_equal(options.statistics, "-");
    assert_true(options.again && options.tells_frames && options.verbose);
    expect_parsed("hedron render --lanes 16 --threads 2 --block 64 --grid 3 --math fast "
                  "--precision double --pipeline wavefront-uncompacted --backend opencl");
    const HdRenderOptions *render = &options.render;
    assert_true(render->lanes == 16 && render->threads == 2);
    assert_true(render->block == 64 && render->grid == 3);
    assert_int_equal(render->math, HD_MATH_FAST);
    assert_int_equal(render->precision, HD_PRECISION_DOUBLE);
    assert_int_equal(render->pipeline, HD_PIPELINE_WAVEFRONT_UNCOMPACTED);
    assert_string_equal(options.backend, "opencl");
    expect_parsed("hedron render --layers depth,object");
    assert_true(options.layers != 0);
    expect_parsed("hedron --default --backend auto --variant 7");
    assert_true(options.prints_default && !options.cpu && !options.gpu);
    assert_null(options.backend);
    assert_int_equal(options.variant, 7);
}
