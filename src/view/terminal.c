/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <chafa.h>

#include "system/interrupt.h"
#include "system/machine.h"
#include "view/viewer.h"

enum {
    ANSWER_WAIT_MS = 1000,
    USUAL_CELL_WIDTH = 8, /* if the terminal does not report it */
    SYMBOL_WIDTH = 2,     /* pixels of a symbol in a row */
    MAX_SIXEL_WIDTH = 640
};

/* Removes a picture of the kitty protocol from the screen. */
static const char kitty_clear[] = "\033_Ga=d,q=2\033\\";

/* Part of the screen, from column and row 1. */
typedef struct Area {
    int left, top, columns, rows;
} Area;

typedef struct Terminal {
    int file; /* the terminal */
    struct termios before;
    bool is_raw;
    ChafaTermInfo *info;     /* owned; its control sequences */
    ChafaSymbolMap *symbols; /* owned; set of symbols */
    ChafaPixelMode protocol; /* protocol of pictures */
    int columns, rows, cell_width, cell_height;
    Area area; /* place of the picture */
    HdViewer *viewer;
    int version; /* version of the shown picture */
    int line_count;
    char lines[HD_VIEW_LINES][HD_VIEW_LINE];
    gchar **shown; /* owned; rows of a picture of symbols; NULL: none is on the screen */
    FILE *out;     /* standard output; if that is the terminal, an owned stream into `printed` */
    char *printed; /* owned; printed at the end */
    size_t said_size;
} Terminal;

/* ---- input and output ---- */

static HdStatus send_text(const Terminal *t, const char *text, HdError *error) {
    while (*text != '\0') {
        const ssize_t sent = write(t->file, text, strlen(text));
        if (sent < 0 && errno == EINTR && hd_interrupt_signal() == 0)
            continue;
        if (sent < 0 && hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted");
        if (sent < 0)
            return hd_fail(error, HD_FAILED, "cannot write to the terminal: %s", strerror(errno));
        text += sent;
    }
    return HD_OK;
}

/* Returns the bytes received within that time; 0: none. */
static int receive(const Terminal *t, char *bytes, int size, int wait_ms) {
    struct pollfd entry = {.fd = t->file, .events = POLLIN};
    if (poll(&entry, 1, wait_ms) <= 0)
        return 0;
    const ssize_t got = read(t->file, bytes, (size_t)size);
    return got > 0 ? (int)got : 0;
}

/* ---- capabilities of the terminal ---- */

static void measure(Terminal *t) {
    struct winsize size = {0};
    if (ioctl(t->file, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
        size.ws_col = 80;
        size.ws_row = 24;
    }
    t->columns = size.ws_col;
    t->rows = size.ws_row;
    t->cell_width = size.ws_xpixel > 0 ? size.ws_xpixel / size.ws_col : USUAL_CELL_WIDTH;
    t->cell_height = size.ws_ypixel > 0 ? size.ws_ypixel / size.ws_row : 2 * USUAL_CELL_WIDTH;
}

/* Finds attribute 4 in the answer to the query of capabilities: "ESC [ ? 62 ; 4 ; 22 c". */
static bool has_sixel(const char *answer) {
    const char *place = strstr(answer, "\033[?");
    while (place != NULL && *place != 'c' && *place != '\0') {
        place += strcspn(place, ";c");
        if (strncmp(place, ";4;", 3) == 0 || strncmp(place, ";4c", 3) == 0)
            return true;
        place += *place == ';';
    }
    return false;
}

/* Queries the terminal, since an environment variable may describe an outer one. Every terminal
   answers the second query, so that the first one cannot block. */
static HdStatus find_protocol(Terminal *t, HdError *error) {
    char answer[512] = "";
    int length = 0, got = 1;
    HD_TRY(send_text(t, "\033_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\033\\\033[c", error));
    while (got > 0 && length < (int)sizeof answer - 1) {
        got = receive(t, answer + length, (int)sizeof answer - 1 - length, ANSWER_WAIT_MS);
        length += got;
        answer[length] = '\0';
        const char *reply = strstr(answer, "\033[?");
        if (reply != NULL && strchr(reply, 'c') != NULL)
            break;
    }
    t->protocol = strstr(answer, "\033_Gi=31;OK") != NULL ? CHAFA_PIXEL_MODE_KITTY
                  : has_sixel(answer)                     ? CHAFA_PIXEL_MODE_SIXELS
                                                          : CHAFA_PIXEL_MODE_SYMBOLS;
    return HD_OK;
}

/* Colours follow the environment, pictures use the sequences of any terminal. A kitty replaces its
   picture by one of the same number, keeps the cursor and does not answer. */
static HdStatus find_sequences(Terminal *t, HdError *error) {
    static const char kitty[] = "\033_Ga=T,f=%1,s=%2,v=%3,c=%4,r=%5,i=1,p=1,q=2,C=1,m=1\033\\";
    ChafaTermDb *all = chafa_term_db_get_default();
    gchar **environment = g_get_environ();
    t->info = chafa_term_db_detect(all, environment);
    g_strfreev(environment);
    t->symbols = chafa_symbol_map_new();
    chafa_symbol_map_add_by_tags(t->symbols, CHAFA_SYMBOL_TAG_BLOCK);
    HD_TRY(find_protocol(t, error));
    if (t->protocol == CHAFA_PIXEL_MODE_SYMBOLS)
        return HD_OK;
    ChafaTermInfo *any = chafa_term_db_get_fallback_info(all);
    chafa_term_info_supplement(t->info, any);
    chafa_term_info_unref(any);
    chafa_term_info_set_seq(t->info, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1, kitty, NULL);
    return HD_OK;
}

/* ---- keys ---- */

/* Waits for keys. An escape sequence counts as a whole; those other than arrows do nothing. */
static void read_keys(Terminal *t) {
    char bytes[256];
    const int count = receive(t, bytes, (int)sizeof bytes, hd_viewer_wait_ms(t->viewer));
    const double now = hd_monotonic_seconds();
    for (int i = 0; i < count; i++) {
        int key = (unsigned char)bytes[i];
        if (key == '\033') {
            i += i + 1 < count && (bytes[i + 1] == '[' || bytes[i + 1] == 'O');
            while (i + 1 < count && (bytes[i + 1] < '@' || bytes[i + 1] > '~'))
                i++;
            i += i + 1 < count;
            key = bytes[i] >= 'A' && bytes[i] <= 'D' ? HD_KEY_UP + bytes[i] - 'A' : 0;
        }
        hd_viewer_key(t->viewer, key, now);
    }
}

/* ---- drawing ---- */

/* Returns the largest area of the picture's shape above the lines. Sixels have the size of the
   screen: few enough columns to be sent in time; below the last row they would scroll. */
static Area place_of_picture(const Terminal *t) {
    int width, height, columns = t->columns, rows = MAX(t->rows - t->line_count, 1);
    hd_viewer_size(t->viewer, &width, &height);
    if (t->protocol == CHAFA_PIXEL_MODE_SIXELS) {
        columns = MIN(columns, MAX(MAX_SIXEL_WIDTH / t->cell_width, 1));
        rows = MIN(rows, MAX(t->rows - 1, 1));
    }
    const double shape = (double)width * t->cell_height / ((double)height * t->cell_width);
    Area area = {.columns = columns, .rows = rows};
    if (columns > rows * shape)
        area.columns = MAX((int)(rows * shape), 1);
    else
        area.rows = MAX((int)(columns / shape), 1);
    area.left = 1 + (t->columns - area.columns) / 2;
    area.top = 1 + (rows - area.rows) / 2;
    return area;
}

/* A kitty scales the picture itself, so that it gets no more pixels than the image has. */
static ChafaCanvas *create_canvas(const Terminal *t, const HdViewImage *image) {
    ChafaCanvasConfig *config = chafa_canvas_config_new();
    const bool has_all = chafa_term_info_have_seq(t->info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_DIRECT);
    const bool has_256 = chafa_term_info_have_seq(t->info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_256);
    int width = t->cell_width, height = t->cell_height;
    if (t->protocol == CHAFA_PIXEL_MODE_KITTY) {
        width = MIN(width, MAX(image->width / t->area.columns, 1));
        height = MIN(height, MAX(image->height / t->area.rows, 1));
    }
    chafa_canvas_config_set_pixel_mode(config, t->protocol);
    chafa_canvas_config_set_canvas_mode(config, has_all || t->protocol != CHAFA_PIXEL_MODE_SYMBOLS
                                                    ? CHAFA_CANVAS_MODE_TRUECOLOR
                                                : has_256 ? CHAFA_CANVAS_MODE_INDEXED_240
                                                          : CHAFA_CANVAS_MODE_INDEXED_16);
    chafa_canvas_config_set_symbol_map(config, t->symbols);
    chafa_canvas_config_set_geometry(config, t->area.columns, t->area.rows);
    chafa_canvas_config_set_cell_geometry(config, width, height);
    ChafaCanvas *canvas = chafa_canvas_new(config);
    chafa_canvas_config_unref(config);
    return canvas;
}

/* Sends the rows that differ from the shown ones. */
static void write_symbols(Terminal *t, const char *text, GString *out) {
    gchar **rows = g_strsplit(text, "\n", t->area.rows);
    for (int i = 0; rows[i] != NULL; i++)
        if (t->shown == NULL || strcmp(rows[i], t->shown[i]) != 0)
            g_string_append_printf(out, "\033[%d;%dH%s", t->area.top + i, t->area.left, rows[i]);
    g_strfreev(t->shown);
    t->shown = rows;
}

static void write_picture(Terminal *t, GString *out) {
    int version = t->version;
    const HdViewImage *image = hd_viewer_picture(t->viewer, &version);
    if (version == t->version || image->width == 0)
        return;
    t->version = version;
    ChafaCanvas *canvas = create_canvas(t, image);
    chafa_canvas_draw_all_pixels(canvas, CHAFA_PIXEL_RGBA8_UNASSOCIATED, image->rgba, image->width,
                                 image->height, 4 * image->width);
    GString *text = chafa_canvas_print(canvas, t->info);
    if (t->protocol == CHAFA_PIXEL_MODE_SYMBOLS)
        write_symbols(t, text->str, out);
    else
        g_string_append_printf(out, "\033[%d;%dH%s", t->area.top, t->area.left, text->str);
    g_string_free(text, TRUE);
    chafa_canvas_unref(canvas);
}

/* Forgets the shown picture too. */
static void clear_screen(Terminal *t, GString *out) {
    g_string_append(out, "\033[0m\033[2J");
    if (t->protocol == CHAFA_PIXEL_MODE_KITTY)
        g_string_append(out, kitty_clear);
    g_strfreev(t->shown);
    t->shown = NULL;
    memset(t->lines, 0, sizeof t->lines);
    t->version = -1;
}

static void write_lines(Terminal *t, char lines[HD_VIEW_LINES][HD_VIEW_LINE], GString *out) {
    const int first = t->rows - t->line_count + 1;
    for (int i = 0; i < t->line_count; i++) {
        if (strcmp(lines[i], t->lines[i]) == 0)
            continue;
        memcpy(t->lines[i], lines[i], HD_VIEW_LINE);
        g_string_append_printf(out, "\033[%d;1H\033[%sm%.*s\033[0m\033[K", first + i,
                               lines[i][0] == '!' ? "91" : "0", t->columns, lines[i]);
    }
}

static void fit_screen(Terminal *t, int line_count, GString *out) {
    const int columns = t->columns, rows = t->rows, lines = t->line_count;
    const Area before = t->area;
    measure(t);
    t->line_count = MIN(line_count, t->rows);
    t->area = place_of_picture(t);
    const bool is_text = t->protocol == CHAFA_PIXEL_MODE_SYMBOLS;
    hd_viewer_limit(t->viewer, t->area.columns * (is_text ? SYMBOL_WIDTH : t->cell_width));
    if (columns != t->columns || rows != t->rows || lines != t->line_count ||
        memcmp(&before, &t->area, sizeof before) != 0)
        clear_screen(t, out);
}

static HdStatus draw(Terminal *t, HdError *error) {
    char lines[HD_VIEW_LINES][HD_VIEW_LINE];
    GString *out = g_string_new(NULL);
    fit_screen(t, hd_viewer_lines(t->viewer, lines), out);
    write_picture(t, out);
    write_lines(t, lines, out);
    HdStatus status = send_text(t, out->str, error);
    g_string_free(out, TRUE);
    return status;
}

/* ---- the loop ---- */

static HdStatus run(Terminal *t, HdError *error) {
    while (hd_viewer_tick(t->viewer, hd_monotonic_seconds())) {
        HD_TRY(draw(t, error));
        read_keys(t);
        if (hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted");
    }
    return HD_OK;
}

/* ---- open and close ---- */

static HdStatus open_terminal(Terminal *t, HdError *error) {
    t->file = open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (t->file < 0)
        return hd_fail(error, HD_UNAVAILABLE,
                       "--terminal needs a terminal, and this program has none (/dev/tty: %s)",
                       strerror(errno));
    if (tcgetattr(t->file, &t->before) != 0)
        return hd_fail(error, HD_UNAVAILABLE, "--terminal needs a terminal: %s", strerror(errno));
    t->out = isatty(STDOUT_FILENO) ? open_memstream(&t->printed, &t->said_size) : stdout;
    return t->out != NULL ? HD_OK : HD_NO_ROOM(error, "a view");
}

static HdStatus set_up_terminal(Terminal *t, HdError *error) {
    struct termios raw = t->before;
    raw.c_iflag &= ~(tcflag_t)(BRKINT | ICRNL | INPCK | ISTRIP | IXON);
    raw.c_oflag &= ~(tcflag_t)OPOST;
    raw.c_lflag &= ~(tcflag_t)(ECHO | ICANON | IEXTEN | ISIG);
    t->is_raw = true;
    if (tcsetattr(t->file, TCSAFLUSH, &raw) != 0)
        return hd_fail(error, HD_FAILED, "cannot read single keys from the terminal: %s",
                       strerror(errno));
    measure(t);
    HD_TRY(send_text(t, "\033[?1049h\033[?25l\033[2J", error));
    return find_sequences(t, error);
}

/* Precedes all waits, so that the terminal echoes again at once. */
static void restore_terminal(Terminal *t) {
    HdError ignored;
    if (!t->is_raw)
        return;
    if (t->protocol == CHAFA_PIXEL_MODE_KITTY)
        (void)send_text(t, kitty_clear, &ignored);
    (void)send_text(t, "\033[0m\033[?25h\033[?1049l", &ignored);
    tcsetattr(t->file, TCSAFLUSH, &t->before);
}

static void close_terminal(Terminal *t) {
    restore_terminal(t);
    hd_viewer_close(t->viewer);
    if (t->file >= 0)
        close(t->file);
    if (t->out != NULL && t->out != stdout)
        fclose(t->out);
    if (t->printed != NULL)
        fputs(t->printed, stdout);
    free(t->printed);
    if (t->info != NULL)
        chafa_term_info_unref(t->info);
    if (t->symbols != NULL)
        chafa_symbol_map_unref(t->symbols);
    g_strfreev(t->shown);
}

HdStatus hd_view_in_terminal(const HdScenePlan *scene, const HdDevicePlan *devices,
                             HdError *error) {
    Terminal t = {.file = -1, .version = -1};
    HdStatus status = open_terminal(&t, error);
    if (status == HD_OK)
        status = hd_viewer_open(&t.viewer, scene, devices, t.out, error);
    if (status == HD_OK)
        status = set_up_terminal(&t, error);
    if (status == HD_OK)
        status = run(&t, error);
    close_terminal(&t);
    return status;
}
