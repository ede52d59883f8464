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

static void check_refused(const char *line, const char *part) {
    assert_int_equal(parse(line), HD_BAD_INPUT);
    expect_contains(error.message, part);
    if (strchr(error.message, '\n') != NULL)
        fail_msg("'%s' has more than one line", error.message);
}

TEST(nothing_is_the_classic_mode) {
    assert_int_equal(parse("hedron"), HD_OK);
    assert_int_equal(options.command, HD_COMMAND_CLASSIC);
    assert_int_equal(options.variant, 4);
    assert_int_equal(options.size.width, 0);
    assert_true(options.cutoff == -1.0);
    assert_int_equal(options.operand_count, 0);
    assert_false(options.quiet || options.verbose);
}

TEST(comparisons_take_two_pictures) {
    assert_int_equal(parse("hedron compare a.png b.pfm"), HD_OK);
    assert_int_equal(options.command, HD_COMMAND_COMPARE);
    assert_string_equal(options.operands[1], "b.pfm");
    assert_true(options.fail_above == -1.0);
    assert_false(options.json || options.curve >= 0);
    assert_null(options.diff);
    assert_int_equal(parse("hedron compare --json a --diff d.PNG b --fail-above .5 --curve=linear"),
                     HD_OK);
    assert_true(options.json && options.fail_above == 0.5);
    assert_int_equal(options.curve, HD_CURVE_LINEAR);
    assert_string_equal(options.diff, "d.PNG");
    assert_int_equal(parse("hedron compare a b --curve srgb --fail-above 255"), HD_OK);
    assert_int_equal(options.curve, HD_CURVE_SRGB);
    check_refused("hedron compare", "needs the names of two pictures");
    check_refused("hedron compare a", "needs the names of two pictures");
    check_refused("hedron compare a b c", "takes two names only, but 'c' came after 'b'");
    check_refused("hedron compare a b --fail-above 256", "expected a number from 0 to 255");
    check_refused("hedron compare a b --fail-above -1", "expected a number from 0 to 255");
    check_refused("hedron compare a b --fail-above nan", "expected a number from 0 to 255");
    check_refused("hedron compare a b --diff d.pfm", "expected a name that ends in .png");
    check_refused("hedron compare a b --curve sRGB", "expected linear or srgb");
    check_refused("hedron compare a b --size 1x1", "--size does not belong to 'hedron compare'");
    check_refused("hedron render --diff d.png", "--diff does not belong to 'hedron render'");
}

TEST(operands_and_options_mix) {
    assert_int_equal(parse("hedron check --help"), HD_OK);
    assert_int_equal(parse("hedron check a.json b.json c.json"), HD_OK);
    assert_int_equal(options.operand_count, 3);
    assert_string_equal(options.operands[0], "a.json");
    assert_string_equal(options.operands[2], "c.json");
    assert_int_equal(parse("hedron render --size 3x4 scene.json -o a.png --depth=2 -o b.gif"),
                     HD_OK);
    assert_int_equal(options.operand_count, 1);
    assert_string_equal(options.operands[0], "scene.json");
    assert_int_equal(options.output_count, 2);
    assert_string_equal(options.outputs[0], "a.png");
    assert_string_equal(options.outputs[1], "b.gif");
    assert_int_equal(options.size.height, 4);
    assert_int_equal(options.depth, 2);
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
    assert_int_equal(parse(repeated("--output=a.png", 8)), HD_OK);
    assert_int_equal(options.output_count, 8);
    check_refused(repeated("--output=a.png", 9), "at most 8");
    assert_int_equal(parse(repeated("--set=a.b=1", 64)), HD_OK);
    assert_int_equal(options.change_count, 64);
    assert_string_equal(options.changes[63], "a.b=1");
    check_refused(repeated("--set=a.b=1", 65), "at most 64");
    check_refused("hedron convert -o a.json -o b.json", "at most 1");
}

TEST(changes_have_a_path_and_a_value) {
    assert_int_equal(parse("hedron render --set a=b=c --set d="), HD_OK);
    assert_string_equal(options.changes[0], "a=b=c");
    check_refused("hedron render --set abc", "PATH=VALUE");
    check_refused("hedron render --set =3", "PATH=VALUE");
    check_refused("hedron render --set", "needs a value");
    check_refused("hedron --set a=1", "--set does not belong to the classic mode");
}

TEST(opposites_exclude_each_other) {
    assert_int_equal(parse("hedron render --quiet --quiet"), HD_OK);
    assert_true(options.quiet && !options.verbose);
    assert_int_equal(parse("hedron --verbose"), HD_OK);
    check_refused("hedron render --quiet --verbose", "only one of --verbose and --quiet");
    check_refused("hedron --verbose --quiet", "only one of --verbose and --quiet");
    check_refused("hedron --cpu --gpu", "only one of --gpu, --cpu and --default");
}

TEST(the_nearest_word_is_suggested) {
    check_refused("hedron rendr", "did you mean 'hedron render'?");
    check_refused("hedron xyzzy", "see 'hedron help'");
    check_refused("hedron foo.json", "did you mean 'hedron render foo.json'?");
    check_refused("hedron dir/foo.JSON --size 1x1", "did you mean 'hedron render dir/foo.JSON'?");
    check_refused("hedron render --smples 3", "did you mean '--samples'?");
    check_refused("hedron render --siz=3x3", "'--siz=3x3'; did you mean '--size'?");
    check_refused("hedron render --frobnicate", "see 'hedron help render'");
    /* Options of other commands are no help. */
    check_refused("hedron devices --siz", "see 'hedron help devices'");
    check_refused("hedron help mann", "did you mean 'hedron help man'?");
    check_refused("hedron help chek", "did you mean 'hedron help check'?");
    check_refused("hedron help x", "see 'hedron help help'");
}

TEST(help_has_topics) {
    assert_int_equal(parse("hedron help"), HD_OK);
    assert_int_equal(options.help_topic.form, HD_HELP_TEXT);
    assert_int_equal(options.help_topic.command, HD_COMMAND_CLASSIC);
    assert_int_equal(parse("hedron help convert"), HD_OK);
    assert_int_equal(options.help_topic.command, HD_COMMAND_CONVERT);
    assert_int_equal(parse("hedron help man"), HD_OK);
    assert_int_equal(options.help_topic.form, HD_HELP_MAN);
    assert_int_equal(parse("hedron help completion"), HD_OK);
    assert_int_equal(options.help_topic.form, HD_HELP_BASH);
    assert_int_equal(parse("hedron check -h"), HD_OK);
    assert_int_equal(options.command, HD_COMMAND_HELP);
    assert_int_equal(options.help_topic.command, HD_COMMAND_CHECK);
    assert_int_equal(parse("hedron help --help"), HD_OK);
    assert_int_equal(options.help_topic.command, HD_COMMAND_HELP);
    check_refused("hedron help man page", "takes one name only");
}

TEST(names_are_counted) {
    check_refused("hedron check", "needs the name of a scene");
    check_refused("hedron check --schema a.json", "looks at no scene");
    assert_int_equal(parse("hedron check --schema"), HD_OK);
    check_refused("hedron render a.json b.json", "'b.json' came after 'a.json'");
    check_refused("hedron devices c", "takes options only, but 'c'");
    check_refused("hedron --stats -", "expected a file");
    assert_int_equal(parse("hedron render --stats -"), HD_OK);
}

TEST(choices_are_words_of_a_list) {
    static const char *const four[] = {"auto", "c", "opencl", "cuda", NULL};
    static const char *const two[] = {"float", "double", NULL};
    static const char *const one[] = {"one", NULL};
    char text[64];
    assert_int_equal(hd_option_choice(four, "auto"), 0);
    assert_int_equal(hd_option_choice(four, "cuda"), 3);
    assert_int_equal(hd_option_choice(four, ""), -1);
    assert_int_equal(hd_option_choice(four, "cud"), -1);
    assert_int_equal(hd_option_choice(four, "c opencl"), -1);
    hd_option_list_choices(four, text, sizeof text);
    assert_string_equal(text, "auto, c, opencl or cuda");
    hd_option_list_choices(two, text, sizeof text);
    assert_string_equal(text, "float or double");
    hd_option_list_choices(one, text, sizeof text);
    assert_string_equal(text, "one");
    hd_option_list_choices(four, text, 8);
    assert_string_equal(text, "auto, c");
}

/* The table has a line for each backend, and every option can be parsed. */
TEST(the_table_is_whole) {
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++) {
        assert_int_equal(strncmp(spec->name, "--", 2), 0);
        assert_non_null(spec->help);
        assert_true(spec->commands != 0);
        if (strcmp(spec->name, "--backend") != 0)
            continue;
        for (int j = 0; j < HD_BACKEND_COUNT; j++)
            assert_true(hd_option_choice(spec->choices, hd_backends[j]->name) > 0);
    }
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        const HdCommandSpec *spec = &hd_command_specs[i];
        char line[64];
        assert_ptr_equal(hd_command_spec(spec->command), spec);
        snprintf(line, sizeof line, "hedron help %s", spec->name != NULL ? spec->name : "");
        assert_int_equal(parse(line), HD_OK);
        assert_int_equal(options.help_topic.command, spec->command);
    }
}

/* Each value reaches its own member. */
TEST(values_reach_their_members) {
    assert_int_equal(parse("hedron render --samples 3 --depth 5 --cutoff .25 --aa adaptive "
                           "--max-error 2 --crop 1x2+3+4 --size 6X7 --geometry triangles "
                           "--divisions 8 --accel bvh --frames 0-9 --device c:0 --stats - "
                           "--again --frame-lines --verbose"),
                     HD_OK);
    assert_int_equal(options.samples, 3);
    assert_int_equal(options.depth, 5);
    assert_true(options.cutoff == 0.25 && options.max_error == 2.0);
    assert_int_equal(options.sampling, HD_SAMPLING_ADAPTIVE);
    assert_int_equal(options.crop.width, 1);
    assert_int_equal(options.crop.height, 2);
    assert_int_equal(options.crop.left, 3);
    assert_int_equal(options.crop.top, 4);
    assert_int_equal(options.size.width, 6);
    assert_int_equal(options.size.height, 7);
    assert_int_equal(options.geometry, HD_GEOMETRY_TRIANGLES);
    assert_int_equal(options.divisions, 8);
    assert_int_equal(options.accel, HD_ACCEL_BVH);
    assert_string_equal(options.frames, "0-9");
    assert_string_equal(options.device, "c:0");
    assert_string_equal(options.statistics, "-");
    assert_true(options.again && options.tells_frames && options.verbose);
    assert_int_equal(parse("hedron render --lanes 16 --threads 2 --block 64 --grid 3 --math fast "
                           "--precision double --pipeline wavefront-uncompacted --backend opencl"),
                     HD_OK);
    assert_int_equal(options.render.lanes, 16);
    assert_int_equal(options.render.threads, 2);
    assert_int_equal(options.render.block, 64);
    assert_int_equal(options.render.grid, 3);
    assert_int_equal(options.render.math, HD_MATH_FAST);
    assert_int_equal(options.render.precision, HD_PRECISION_DOUBLE);
    assert_int_equal(options.render.pipeline, HD_PIPELINE_WAVEFRONT_UNCOMPACTED);
    assert_string_equal(options.backend, "opencl");
    assert_int_equal(parse("hedron --default --backend auto --variant 7"), HD_OK);
    assert_true(options.prints_default && !options.cpu && !options.gpu);
    assert_null(options.backend);
    assert_int_equal(options.variant, 7);
}
