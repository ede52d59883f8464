/* SPDX-License-Identifier: MIT */
/* Values of each option, the commands that have it, and the members that it sets. */
#include <stdio.h>

#include "cli/options.h"
#include "device/renderer.h"
#include "unit_test.h"

static HdOptions options;
static HdError error;

/* Parses words that are separated by spaces and, unless it is NULL, one more unchanged; the texts
   live until the next call. */
static HdStatus parse(const char *line, const char *last) {
    static char text[4096], whole[60000];
    static char *arguments[100];
    int count = 0;
    strcpy(text, line);
    for (char *word = strtok(text, " "); word != NULL; word = strtok(NULL, " "))
        arguments[count++] = word;
    if (last != NULL)
        arguments[count++] = strcpy(whole, last);
    arguments[count] = NULL;
    error.message[0] = '\0';
    return hd_options_parse(&options, count, arguments, &error);
}

static void expect_parsed(const char *line) {
    if (parse(line, NULL) != HD_OK)
        fail_msg("'%s': %s", line, error.message);
}

static void check_refused(const char *line, const char *last, const char *part) {
    if (parse(line, last) != HD_BAD_INPUT)
        fail_msg("'%s' '%s' is not refused", line, last != NULL ? last : "");
    expect_contains(error.message, part);
    if (strlen(error.message) < 10 || strchr(error.message, '\n') != NULL)
        fail_msg("'%s' is no sentence", error.message);
}

/* Right and wrong values, separated by "|". */
static const struct {
    const char *option, *right, *wrong;
} cases[] = {
    {"--size", "1x1|33X25|65535x65535",
     "|0x24|32x0|-32x24|32x-24|32|32x|x24|32x24x3|65536x1|1x65536|abc|3.5x4|"
     "99999999999999999999x1|32 x 24| 5x5|+5x5|5x+5|5x 5"},
    {"--variant", "1|10", "|0|11|-1|1.5|TOD|99999999999"},
    {"--crop", "1x1+0+0|65535x65535+65535+65535", "|8x8|8x8+1|0x8+1+1|8x8+-1+1|8x8+1+65536|a"},
    {"--samples", "1|3", "|0|-1|1.5|abc|1x|99999999999|100000| 1|+1"},
    {"--depth", "0|3", "|-1|1.5|abc|99999999999|100000"},
    {"--cutoff", "0|0.5|1e-3|.5|1.e-1|0E+1",
     "|1|1.5|-0.1|nan|inf|abc|0.1x|0x.8p0| 0.5|+0.5|.|1e|0.5e-"},
    {"--max-error", "0.5|9", "|0|-1|1e9|abc"},
    {"--lanes", "1|2|4|8|16", "|0|3|32|-4|abc|4x| 4"},
    {"--threads", "1|2|64", "|0|-1|1.5|abc|100000|99999999999999999999"},
    {"--pipeline", "auto|mega|wavefront|wavefront-uncompacted", "|Mega|wave|1"},
    {"--geometry", "solids|triangles", "|solid|Triangles|1"},
    {"--divisions", "1|2|1000", "|0|-1|1.5|abc|1001"},
    {"--accel", "auto|brute|bvh", "|tree|1"},
    {"--block", "32|96|256", "|0|1|33|288|-32|abc"},
    {"--grid", "1|7|1048576", "|0|-1|1048577|abc"},
    {"--max-launch", "1|12.5|10000", "|0|0.5|-1|10001|abc"},
    {"--precision", "float|double", "|single|Float|64"},
    {"--math", "strict|fast", "|loose|Strict"},
    {"--aa", "grid|multijitter", "|Grid|1"},
    {"--backend", "auto|c|opencl|cuda", "|vulkan|C| c"},
    {"--set", "a=1|a.b=", "|abc|=1"},
    {"--stats", "-|a.jsonl", ""},
    {"--device", "0|c:0|a card", ""},
    {"--output", "a.png|%d.data|a.mp4", "|a|a.jpg|film.avi|out/%d.jpg|folder/"},
};

/* Returns the text number `number` of a list; false: there is none. */
static bool take(const char *list, int number, char text[64]) {
    for (; number > 0; number--) {
        list = strchr(list, '|');
        if (list == NULL)
            return false;
        list++;
    }
    snprintf(text, 64, "%.*s", (int)strcspn(list, "|"), list);
    return true;
}

TEST(each_option_takes_its_values_and_no_others) {
    char text[64], line[64], joined[128];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *option = cases[i].option;
        const char *command = strcmp(option, "--variant") == 0 ? "hedron" : "hedron render";
        snprintf(line, sizeof line, "%s %s", command, option);
        for (int j = 0; take(cases[i].right, j, text); j++) {
            snprintf(joined, sizeof joined, "%s=%s", option, text);
            if (parse(line, text) != HD_OK || parse(command, joined) != HD_OK)
                fail_msg("%s '%s' is refused: %s", option, text, error.message);
        }
        for (int j = 0; take(cases[i].wrong, j, text); j++) {
            snprintf(joined, sizeof joined, "%s=%s", option, text);
            check_refused(command, joined, option);
            check_refused(line, text, option);
        }
    }
}

/* An option with two entries, with other words for another command, belongs to both. */
static unsigned commands_of(const char *name) {
    unsigned commands = 0;
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++)
        if (strcmp(spec->name, name) == 0)
            commands |= spec->commands;
    return commands;
}

/* Reports missing and surplus values, and a command that does not have the option. */
TEST(options_belong_to_their_commands_and_have_values_or_none) {
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++)
        for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
            const HdCommandSpec *command = &hd_command_specs[i];
            char line[64], text[64], part[64];
            snprintf(line, sizeof line, "hedron %s", command->name != NULL ? command->name : "");
            snprintf(text, sizeof text, "%s=1", spec->name);
            if ((commands_of(spec->name) & (unsigned)command->command) == 0) {
                snprintf(part, sizeof part, "%s does not belong to ", spec->name);
                check_refused(line, text, part);
                expect_contains(error.message,
                                command->name != NULL ? command->name : "the classic mode");
            } else if (spec->value == NULL) {
                snprintf(part, sizeof part, "%s takes no value, but '1'", spec->name);
                check_refused(line, text, part);
            } else {
                snprintf(part, sizeof part, "%s needs a value", spec->name);
                check_refused(line, spec->name, part);
            }
        }
}

TEST(unknown_options_are_refused) {
    static const char *const commands[] = {"hedron", "hedron devices", "hedron render"};
    static const char *const wrong[] = {"--nonsense=1", "-x",    "--sizes=1x1", "-gpu",     "--GPU",
                                        "-oh",          "",      "--=1",        "-o=a.png", "-",
                                        "word",         "Render"};
    static char text[50000];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (int j = 0; j < (i < 9 ? 3 : 2); j++) /* the last ones may be scenes */
            check_refused(commands[j], wrong[i], "");
    check_refused("hedron render", "--nonsense=1", "'--nonsense=1'");
    memset(text, 'x', sizeof text - 1);
    check_refused("hedron render --depth", text, "--depth");
    memcpy(text, "--", 2);
    check_refused("hedron render", text, "unknown option");
}

TEST(wrong_lines_are_refused) {
    static const char *const lines[][2] = {
        {"compare", "needs the names of two pictures"},
        {"compare a b c", "takes two names only, but 'c' came after 'b'"},
        {"compare a b --fail-above 256", "expected a number from 0 to 255"},
        {"compare a b --fail-above nan", "expected a number from 0 to 255"},
        {"compare a b --diff d.pfm", "expected a name that ends in .png"},
        {"compare a b --curve sRGB", "expected linear or srgb"},
        {"convert -o a.json -o b.json", "at most 1"},
        {"render --layers depth,depth", "--layers has depth twice"},
        {"render --layers depth,dep", "--layers has 'dep', expected some of "},
        /* opposites */
        {"render --quiet --verbose", "only one of --verbose and --quiet"},
        {"--verbose --quiet", "only one of --verbose and --quiet"},
        {"--cpu --gpu", "only one of --gpu, --cpu and --default"},
        /* the nearest word, never an option of another command */
        {"rendr", "did you mean 'hedron render'?"},
        {"xyzzy", "see 'hedron help'"},
        {"foo.json", "did you mean 'hedron render foo.json'?"},
        {"dir/foo.JSON --size 1x1", "did you mean 'hedron render dir/foo.JSON'?"},
        {"render --smples 3", "did you mean '--samples'?"},
        {"render --siz=3x3", "'--siz=3x3'; did you mean '--size'?"},
        {"render --frobnicate", "see 'hedron help render'"},
        {"devices --siz", "see 'hedron help devices'"},
        {"help chek", "did you mean 'hedron help check'?"},
        {"help x", "expected render, view, new, check, "},
        {"help x", "completion, completion-zsh or completion-fish"},
        {"render --backend vulkan", "expected auto, c, opencl or cuda"},
        {"device", "did you mean 'hedron devices'?"},
        {"--cpu render", "did you mean 'hedron render'?"},
        {"completion", "did you mean 'hedron help completion'?"},
        {"version", "did you mean 'hedron --version'?"},
        {"hlep", "did you mean 'hedron help'?"},
        {"check --shema", "did you mean '--schema'?"},
        {"help completions", "did you mean 'hedron help completion'?"},
        {"render --backend open", "did you mean 'opencl'?"},
        {"scenes/classic.in",
         "the classic mode reads standard input: hedron --cpu < scenes/classic.in"},
        /* too few and too many names */
        {"help man page", "takes one name only"},
        {"check --", "needs the name of a scene"},
        {"convert one.in two.in", ""},
        {"check --schema a.json", "reads no scene"},
        {"render a.json b.json", "'b.json' came after 'a.json'"},
        {"devices c", "takes options only, but 'c'"},
        {"--stats -", "expected a file"},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[128];
        snprintf(line, sizeof line, "hedron %s", lines[i][0]);
        check_refused(line, NULL, lines[i][1]);
    }
}

TEST(nothing_is_the_classic_mode) {
    expect_parsed("hedron");
    assert_int_equal(options.command, HD_COMMAND_CLASSIC);
    assert_int_equal(options.scene.variant, 4);
    assert_int_equal(options.scene.size.width, 0);
    assert_true(options.scene.cutoff == -1.0);
    assert_int_equal(options.operand_count, 0);
    assert_false(options.reporting.quiet || options.reporting.verbose);
}

TEST(comparisons_take_two_pictures) {
    expect_parsed("hedron compare a.png b.pfm");
    assert_int_equal(options.command, HD_COMMAND_COMPARE);
    assert_true(options.fail_above == -1.0);
    assert_false(options.json || options.curve >= 0);
    assert_null(options.diff);
    expect_parsed("hedron compare --json a --diff d.PNG b --fail-above .5 --curve=linear");
    assert_true(options.json && options.fail_above == 0.5);
    assert_int_equal(options.curve, HD_CURVE_LINEAR);
    assert_string_equal(options.diff, "d.PNG");
    assert_string_equal(options.operands[1], "b");
    expect_parsed("hedron compare a b --curve srgb --fail-above 255");
}

/* After "--" there are names only; "-oNAME" is one word; the last of several values counts. */
TEST(operands_and_options_mix) {
    expect_parsed("hedron check --schema");
    expect_parsed("hedron check a.json b.json -- --schema");
    assert_int_equal(options.operand_count, 3);
    assert_string_equal(options.operands[2], "--schema");
    expect_parsed("hedron render --size 3x4 scene.json -o a.png --depth=5 --depth=2 -ob.gif");
    assert_int_equal(options.operand_count, 1);
    assert_string_equal(options.operands[0], "scene.json");
    assert_int_equal(options.store.count, 2);
    assert_string_equal(options.store.names[0], "a.png");
    assert_string_equal(options.store.names[1], "b.gif");
    assert_int_equal(options.scene.size.height, 4);
    assert_int_equal(options.scene.depth, 2);
    expect_parsed("hedron render --set a=b=c --set d= --quiet --quiet");
    assert_string_equal(options.scene.changes[0], "a=b=c");
    expect_parsed("hedron -V");
    assert_int_equal(options.command, HD_COMMAND_VERSION);
    for (int i = 0; i < 9; i++) {
        static const char *const modes[] = {"--gpu", "--cpu", "--default"};
        char line[32];
        snprintf(line, sizeof line, "hedron %s", modes[i / 3]);
        assert_int_equal(parse(line, modes[i % 3]), i / 3 == i % 3 ? HD_OK : HD_BAD_INPUT);
    }
}

/* Returns a line with so many repetitions of an option. */
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
    assert_int_equal(options.store.count, 8);
    check_refused(repeated("--output=a.png", 9), NULL, "at most 8");
    expect_parsed(repeated("--set=a.b=1", 64));
    assert_int_equal(options.scene.change_count, 64);
    assert_string_equal(options.scene.changes[63], "a.b=1");
    check_refused(repeated("--set=a.b=1", 65), NULL, "at most 64");
}

TEST(help_has_topics) {
    static const char *const lines[][2] = {{"hedron help man", "man"},
                                           {"hedron help completion", "completion"},
                                           {"hedron check -h", "check"},
                                           {"hedron check --help --nonsense", "check"},
                                           {"hedron help --help", "help"}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        expect_parsed(lines[i][0]);
        assert_int_equal(options.command, HD_COMMAND_HELP);
        assert_string_equal(options.topic, lines[i][1]);
    }
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        const HdCommandSpec *spec = &hd_command_specs[i];
        char line[64];
        assert_ptr_equal(hd_command_spec(spec->command), spec);
        snprintf(line, sizeof line, "hedron help %s", spec->name != NULL ? spec->name : "");
        expect_parsed(line);
        assert_ptr_equal(options.topic != NULL ? hd_command_named(options.topic) : NULL,
                         spec->name != NULL ? spec : NULL);
    }
}

/* Each value reaches its own member. */
TEST(values_reach_their_members) {
    expect_parsed("hedron render --samples 3 --depth 5 --cutoff .25 --aa multijitter "
                  "--max-error 2 --crop 1x2+3+4 --size 6X7 --geometry triangles "
                  "--divisions 8 --accel bvh --frames 0-9 --device c:0 --stats - "
                  "--again --frame-lines --verbose");
    const HdPlannedArea *crop = &options.scene.crop;
    assert_true(options.scene.samples == 3 && options.scene.depth == 5 &&
                options.scene.divisions == 8);
    assert_true(options.scene.cutoff == 0.25 && options.scene.max_error == 2.0);
    assert_int_equal(options.scene.sampling, HD_SAMPLING_MULTIJITTER);
    assert_true(crop->width == 1 && crop->height == 2 && crop->left == 3 && crop->top == 4);
    assert_true(options.scene.size.width == 6 && options.scene.size.height == 7);
    assert_int_equal(options.scene.geometry, HD_GEOMETRY_TRIANGLES);
    assert_int_equal(options.scene.accel, HD_ACCEL_BVH);
    assert_string_equal(options.frames, "0-9");
    assert_string_equal(options.devices.device, "c:0");
    assert_string_equal(options.store.statistics, "-");
    assert_true(options.store.again && options.reporting.reports_frames &&
                options.reporting.verbose);
    expect_parsed("hedron render --lanes 16 --threads 2 --block 64 --grid 3 --math fast "
                  "--precision double --pipeline wavefront-uncompacted --backend opencl");
    const HdRenderOptions *render = &options.devices.render;
    assert_true(render->lanes == 16 && render->threads == 2);
    assert_true(render->block == 64 && render->grid == 3);
    assert_int_equal(render->math, HD_MATH_FAST);
    assert_int_equal(render->precision, HD_PRECISION_DOUBLE);
    assert_int_equal(render->pipeline, HD_PIPELINE_WAVEFRONT_UNCOMPACTED);
    assert_string_equal(options.devices.backend, "opencl");
    expect_parsed("hedron render --layers depth,object");
    assert_true(options.store.layers != 0);
    expect_parsed("hedron --default --backend auto --variant 7");
    assert_true(options.prints_default && !options.cpu && !options.gpu);
    assert_null(options.devices.backend);
    assert_int_equal(options.scene.variant, 7);
}

/* Values that follow from several options, or from the command, are set after parsing; messages
   have the options as given. */
TEST(the_plan_is_complete) {
    const HdScenePlan *scene = &options.scene;
    expect_parsed("hedron render a.json --reference --size 6x7 --set a=b");
    assert_string_equal(scene->path, "a.json");
    assert_true(scene->sampling == HD_SAMPLING_REFERENCE && scene->samples == 32);
    assert_true(scene->max_error == 1.0 / 64.0 && !scene->is_classic);
    assert_int_equal(options.devices.render.precision, HD_PRECISION_DOUBLE);
    assert_string_equal(scene->given, "--size 6x7");
    assert_string_equal(options.store.given, "--set a=b --size 6x7 --reference --precision double");
    assert_true(options.reporting.wants_lines && !options.store.again);
    expect_parsed("hedron render --reference --samples 2 --max-error 2");
    assert_true(scene->path == NULL && scene->samples == 2 && scene->max_error == 2.0);
    expect_parsed("hedron --cpu");
    assert_true(scene->is_classic && options.store.again && !options.reporting.wants_lines);
    assert_int_equal(options.devices.kind, HD_ONLY_CPU);
}
