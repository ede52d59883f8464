/* SPDX-License-Identifier: MIT */
/* What each option takes, and which command takes which option. */
#include <stdio.h>

#include "cli/option_values.h"
#include "unit_test.h"

static HdOptions options;
static HdError error;

/* Parses these words and up to two more; NULL: no such word. */
static HdStatus parse(const char *command, const char *word, const char *other) {
    static char texts[4][100000];
    static char *arguments[5];
    const char *const words[] = {"hedron", command, word, other};
    int count = 0;
    for (int i = 0; i < 4; i++)
        if (words[i] != NULL) {
            strcpy(texts[count], words[i]);
            arguments[count] = texts[count];
            count++;
        }
    arguments[count] = NULL;
    error.message[0] = '\0';
    return hd_options_parse(&options, count, arguments, &error);
}

static void expect_refused(const char *part) {
    expect_contains(error.message, part);
    if (strlen(error.message) < 10 || strchr(error.message, '\n') != NULL)
        fail_msg("'%s' is no sentence", error.message);
}

/* What is right and wrong, separated by "|". */
static const struct {
    const char *option, *right, *wrong;
} cases[] = {
    {"--size", "1x1|33X25|65535x65535",
     "|0x24|32x0|-32x24|32x-24|32|32x|x24|32x24x3|65536x1|1x65536|abc|3.5x4|"
     "99999999999999999999x1|32 x 24| 5x5|+5x5|5x+5|5x 5"},
    {"--crop", "1x1+0+0|65535x65535+65535+65535", "|8x8|8x8+1|0x8+1+1|8x8+-1+1|8x8+1+65536|a"},
    {"--samples", "1|3", "|0|-1|1.5|abc|1x|99999999999|100000| 1|+1"},
    {"--depth", "0|3", "|-1|1.5|abc|99999999999|100000"},
    {"--cutoff", "0|0.5|1e-3|.5|1.e-1|0E+1",
     "|1|1.5|-0.1|nan|inf|abc|0.1x|0x.8p0| 0.5|+0.5|.|1e|0.5e-"},
    {"--max-error", "0.5|9", "|0|-1|1e9|abc"},
    {"--lanes", "1|4|8|16", "|0|2|3|32|-4|abc|4x| 4"},
    {"--threads", "1|2|64", "|0|-1|1.5|abc|100000|99999999999999999999"},
    {"--pipeline", "auto|mega|wavefront|wavefront-uncompacted", "|Mega|wave|1"},
    {"--geometry", "solids|triangles", "|solid|Triangles|1"},
    {"--divisions", "1|2|1000", "|0|-1|1.5|abc|1001"},
    {"--accel", "auto|brute|bvh", "|tree|1"},
    {"--block", "32|96|1024", "|0|1|33|1056|-32|abc"},
    {"--grid", "1|7|1048576", "|0|-1|1048577|abc"},
    {"--max-launch", "1|12.5|10000", "|0|0.5|-1|10001|abc"},
    {"--precision", "float|double", "|single|Float|64"},
    {"--math", "strict|fast", "|loose|Strict"},
    {"--aa", "grid|adaptive", "|Grid|1"},
    {"--backend", "auto|c|opencl|cuda", "|vulkan|C| c"},
    {"--set", "a=1|a.b=", "|abc|=1"},
    {"--stats", "-|a.jsonl", ""},
    {"--device", "0|c:0|a card", ""},
    {"--output", "a.png|%d.data|a.mp4", "|a|a.jpg|film.avi|out/%d.jpg|folder/"},
};

/* The `number`th text of a list; false: there is none. */
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
    char text[64], joined[128];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (int j = 0; take(cases[i].right, j, text); j++) {
            snprintf(joined, sizeof joined, "%s=%s", cases[i].option, text);
            if (parse("render", cases[i].option, text) != HD_OK ||
                parse("render", joined, NULL) != HD_OK)
                fail_msg("%s '%s' is refused: %s", cases[i].option, text, error.message);
        }
        for (int j = 0; take(cases[i].wrong, j, text); j++) {
            snprintf(joined, sizeof joined, "%s=%s", cases[i].option, text);
            if (parse("render", joined, NULL) != HD_BAD_INPUT ||
                parse("render", cases[i].option, text) != HD_BAD_INPUT)
                fail_msg("%s '%s' is taken", cases[i].option, text);
            expect_refused(cases[i].option);
        }
    }
}

TEST(the_variants_are_numbers_from_1_to_10) {
    static const char *const wrong[] = {"0", "11", "-1", "1.5", "TOD", "", "99999999999"};
    assert_int_equal(parse(NULL, "--variant", "10"), HD_OK);
    assert_int_equal(options.variant, 10);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(parse(NULL, "--variant", wrong[i]), HD_BAD_INPUT);
        expect_refused("--variant");
    }
}

/* An option that is there twice, with other words for another command, belongs to both. */
static unsigned commands_of(const char *name) {
    unsigned commands = 0;
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++)
        if (strcmp(spec->name, name) == 0)
            commands |= spec->commands;
    return commands;
}

/* What is missing or too much is told, and so is a command that does not have the option. */
TEST(options_belong_to_their_commands_and_have_values_or_none) {
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++)
        for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
            const HdCommandSpec *command = &hd_command_specs[i];
            char text[64];
            snprintf(text, sizeof text, "%s=1", spec->name);
            if ((commands_of(spec->name) & (unsigned)command->command) == 0) {
                assert_int_equal(parse(command->name, text, NULL), HD_BAD_INPUT);
                snprintf(text, sizeof text, "%s does not belong to ", spec->name);
                expect_refused(text);
                expect_refused(command->name != NULL ? command->name : "the classic mode");
            } else if (spec->value == NULL) {
                assert_int_equal(parse(command->name, text, NULL), HD_BAD_INPUT);
                snprintf(text, sizeof text, "%s takes no value, but '1'", spec->name);
                expect_refused(text);
            } else {
                assert_int_equal(parse(command->name, spec->name, NULL), HD_BAD_INPUT);
                snprintf(text, sizeof text, "%s needs a value", spec->name);
                expect_refused(text);
            }
        }
}

TEST(what_is_no_option_is_refused) {
    static const char *const commands[] = {NULL, "devices", "render"};
    static const char *const wrong[] = {
        "--nonsense", "--nonsense=1", "-x",       "--siz=32x24", "--sizes=1x1",
        "-gpu",       "--GPU",        "--gpus",   "-cpu",        "-oh",
        "",           "--=1",         "-o=a.png", "-",           "word",
        "Render"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (int j = 0; j < (i < 13 ? 3 : 2); j++) { /* the last ones may be scenes */
            if (parse(commands[j], wrong[i], NULL) != HD_BAD_INPUT)
                fail_msg("'%s' is taken", wrong[i]);
            expect_refused("");
        }
    assert_int_equal(parse("render", "--nonsense=1", NULL), HD_BAD_INPUT);
    expect_refused("'--nonsense=1'");
    assert_int_equal(parse("--cpu", "render", NULL), HD_BAD_INPUT);
    assert_int_equal(parse("render", "--help", "--nonsense"), HD_OK);
    assert_int_equal(options.command, HD_COMMAND_HELP);
}

TEST(texts_of_any_length_are_refused) {
    static char text[60000];
    memset(text, '0', sizeof text - 2);
    text[sizeof text - 2] = 'x';
    assert_int_equal(parse("render", "--depth", text), HD_BAD_INPUT);
    expect_refused("--depth");
    memcpy(text, "--", 2);
    assert_int_equal(parse("render", text, NULL), HD_BAD_INPUT);
    expect_refused("unknown option");
}

TEST(what_was_meant_is_told) {
    static const struct {
        const char *words[3], *meant;
    } meants[] = {
        {{"device"}, "did you mean 'hedron devices'?"},
        {{"--cpu", "render"}, "did you mean 'hedron render'?"},
        {{"completion"}, "did you mean 'hedron help completion'?"},
        {{"man"}, "did you mean 'hedron help man'?"},
        {{"version"}, "did you mean 'hedron --version'?"},
        {{"hlep"}, "did you mean 'hedron help'?"},
        {{"render", "--sample", "3"}, "did you mean '--samples'?"},
        {{"check", "--shema"}, "did you mean '--schema'?"},
        {{"help", "completions"}, "did you mean 'hedron help completion'?"},
        {{"render", "--backend", "open"}, "did you mean 'opencl'?"},
        {{"scenes/classic.in"},
         "the classic mode reads standard input: hedron --cpu < scenes/classic.in"},
    };
    for (size_t i = 0; i < sizeof meants / sizeof *meants; i++) {
        assert_int_equal(parse(meants[i].words[0], meants[i].words[1], meants[i].words[2]),
                         HD_BAD_INPUT);
        expect_refused(meants[i].meant);
    }
}

/* Behind "--" there are names only; "-oNAME" is one word; the last of several values counts. */
TEST(short_forms_and_the_end_of_the_options) {
    assert_int_equal(parse("check", "--", "--schema"), HD_OK);
    assert_string_equal(options.operands[0], "--schema");
    assert_int_equal(parse("check", "--", NULL), HD_BAD_INPUT);
    expect_refused("needs the name of a scene");
    assert_int_equal(parse("render", "-oshort.data", NULL), HD_OK);
    assert_string_equal(options.outputs[0], "short.data");
    assert_int_equal(parse("render", "--depth=5", "--depth=6"), HD_OK);
    assert_int_equal(options.depth, 6);
    assert_int_equal(parse("-V", NULL, NULL), HD_OK);
    assert_int_equal(options.command, HD_COMMAND_VERSION);
    assert_int_equal(parse("convert", "one.in", "two.in"), HD_BAD_INPUT);
    assert_int_equal(parse("--cpu", "--cpu", NULL), HD_OK);
    for (int i = 0; i < 9; i++) {
        static const char *const modes[] = {"--gpu", "--cpu", "--default"};
        assert_int_equal(parse(modes[i / 3], modes[i % 3], NULL),
                         i / 3 == i % 3 ? HD_OK : HD_BAD_INPUT);
    }
}
