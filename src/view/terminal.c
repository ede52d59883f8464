/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/terminal.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "system/interrupt.h"
#include "system/machine.h"
#include "view/glyphs.h"
#include "view/scale.h"
#include "view/viewer.h"

enum {
    MOVING_WAIT_MS = 4,
    IDLE_WAIT_MS = 100,
    ANSWER_WAIT_MS = 1000,
    USUAL_CELL_WIDTH = 8, /* where the terminal does not tell */
    MOST_SIXEL_WIDTH = 640
};

typedef enum Protocol { HALF_BLOCKS, KITTY, SIXEL } Protocol;

typedef struct Terminal {
    int file; /* the terminal */
    struct termios before;
    bool is_raw;
    Protocol protocol;
    int columns, rows, cell_width, cell_height;
    int wakes[2]; /* a pipe, by which workers wake the loop */
    HdViewer *viewer;
    int version; /* of the picture that is shown */
    int line_count;
    char lines[HD_VIEW_LINES][HD_VIEW_LINE];
    HdHalfBlocks blocks;
    uint8_t *scaled; /* owned */
    size_t scaled_room;
    char *said; /* owned; for the end */
    size_t said_length;
} Terminal;

/* ---- bytes to and fro ---- */

static HdStatus send_bytes(const Terminal *t, const char *bytes, size_t size, HdError *error) {
    while (size > 0) {
        const ssize_t sent = write(t->file, bytes, size);
        if (sent < 0 && errno == EINTR && hd_interrupt_signal() == 0)
            continue;
        if (sent < 0 && hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted");
        if (sent < 0)
            return hd_fail(error, HD_FAILED, "cannot write to the terminal: %s", strerror(errno));
        bytes += sent;
        size -= (size_t)sent;
    }
    return HD_OK;
}

static HdStatus send_text(const Terminal *t, const char *text, HdError *error) {
    return send_bytes(t, text, strlen(text), error);
}

/* What comes within that time; 0: nothing. */
static int receive(const Terminal *t, char *bytes, int size, int wait_ms) {
    struct pollfd entry = {.fd = t->file, .events = POLLIN};
    if (poll(&entry, 1, wait_ms) <= 0)
        return 0;
    const ssize_t got = read(t->file, bytes, (size_t)size);
    return got > 0 ? (int)got : 0;
}

/* ---- what the terminal is ---- */

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

/* Attribute 4 of the answer to the question what the terminal can do: "ESC [ ? 62 ; 4 ; 22 c". */
static bool tells_sixel(const char *answer) {
    const char *place = strstr(answer, "\033[?");
    while (place != NULL && *place != 'c' && *place != '\0') {
        place += strcspn(place, ";c");
        if (strncmp(place, ";4;", 3) == 0 || strncmp(place, ";4c", 3) == 0)
            return true;
        place += *place == ';';
    }
    return false;
}

/* Every terminal answers the second question, so that nobody waits for an answer to the first. */
static HdStatus find_protocol(Terminal *t, HdError *error) {
    char answer[512] = "";
    int length = 0, got = 1;
    HdStatus status = send_text(t, "\033_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\033\\\033[c", error);
    while (status == HD_OK && got > 0 && length < (int)sizeof answer - 1) {
        got = receive(t, answer + length, (int)sizeof answer - 1 - length, ANSWER_WAIT_MS);
        length += got;
        answer[length] = '\0';
        const char *told = strstr(answer, "\033[?");
        if (told != NULL && strchr(told, 'c') != NULL)
            break;
    }
    t->protocol = strstr(answer, "\033_Gi=31;OK") != NULL ? KITTY
                  : tells_sixel(answer)                   ? SIXEL
                                                          : HALF_BLOCKS;
    return status;
}

/* ---- keys ---- */

static int arrow(char letter) {
    switch (letter) {
    case 'A':
        return HD_KEY_UP;
    case 'B':
        return HD_KEY_DOWN;
    case 'C':
        return HD_KEY_RIGHT;
    case 'D':
        return HD_KEY_LEFT;
    default:
        return 0;
    }
}

/* An escape sequence counts as a whole; what is no arrow does nothing. */
static void take_keys(Terminal *t) {
    char bytes[256];
    const int count = receive(t, bytes, (int)sizeof bytes, 0);
    const double now = hd_monotonic_seconds();
    for (int i = 0; i < count; i++) {
        int key = (unsigned char)bytes[i];
        if (key == '\033') {
            i += i + 1 < count && (bytes[i + 1] == '[' || bytes[i + 1] == 'O');
            while (i + 1 < count && (bytes[i + 1] < '@' || bytes[i + 1] > '~'))
                i++;
            i += i + 1 < count;
            key = arrow(bytes[i]);
        }
        hd_viewer_key(t->viewer, key, now);
    }
}

/* ---- drawing ---- */

/* The largest area of the picture's shape above the lines. */
static HdTextArea place_of_picture(const Terminal *t) {
    int width, height;
    hd_viewer_size(t->viewer, &width, &height);
    const int rows = t->rows - t->line_count > 1 ? t->rows - t->line_count : 1;
    const double shape = (double)width * t->cell_height / ((double)height * t->cell_width);
    HdTextArea area = {.columns = t->columns, .rows = rows};
    if (t->columns > rows * shape)
        area.columns = (int)(rows * shape) > 0 ? (int)(rows * shape) : 1;
    else
        area.rows = (int)(t->columns / shape) > 0 ? (int)(t->columns / shape) : 1;
    area.left = 1 + (t->columns - area.columns) / 2;
    area.top = 1 + (rows - area.rows) / 2;
    return area;
}

static HdStatus scale(Terminal *t, const HdViewImage *image, int width, int height,
                      HdError *error) {
    const size_t bytes = 4 * (size_t)width * (size_t)height;
    if (bytes > t->scaled_room) {
        uint8_t *scaled = realloc(t->scaled, bytes);
        if (scaled == NULL)
            return hd_fail(error, HD_FAILED, "out of memory: no room for the terminal's picture");
        t->scaled = scaled;
        t->scaled_room = bytes;
    }
    hd_scale_rgba(image->rgba, image->width, image->height, t->scaled, width, height, 4 * width);
    return HD_OK;
}

/* Sixels are sent at the size that they have on the screen, up to a width at which they are still
   sent in time. */
static HdStatus write_sixels(Terminal *t, const HdViewImage *image, const HdTextArea *area,
                             FILE *out, HdError *error) {
    int width = area->columns * t->cell_width, height = area->rows * t->cell_height;
    if (width > MOST_SIXEL_WIDTH) {
        height = height * MOST_SIXEL_WIDTH / width;
        width = MOST_SIXEL_WIDTH;
    }
    HdStatus status = scale(t, image, width, height, error);
    if (status == HD_OK)
        hd_sixel_write(area, t->scaled, width, height, out);
    return status;
}

/* No more pixels are sent than the screen has. */
static HdStatus write_kitty(Terminal *t, const HdViewImage *image, const HdTextArea *area,
                            FILE *out, HdError *error) {
    const int most = area->columns * t->cell_width;
    const int width = image->width < most ? image->width : most;
    const int height = (int)((double)image->height * width / image->width);
    HdStatus status = scale(t, image, width, height > 0 ? height : 1, error);
    if (status == HD_OK)
        hd_kitty_write(area, t->scaled, width, height > 0 ? height : 1, out);
    return status;
}

static HdStatus write_picture(Terminal *t, FILE *out, HdError *error) {
    const HdTextArea area = place_of_picture(t);
    int version = t->version;
    const HdViewImage *image = hd_viewer_picture(t->viewer, &version);
    if (version == t->version || image->width == 0)
        return HD_OK;
    t->version = version;
    if (t->protocol == KITTY)
        return write_kitty(t, image, &area, out, error);
    if (t->protocol == SIXEL)
        return write_sixels(t, image, &area, out, error);
    HdStatus status = scale(t, image, area.columns, 2 * area.rows, error);
    return status == HD_OK ? hd_half_blocks_write(&t->blocks, &area, t->scaled, out, error)
                           : status;
}

/* What was on the screen is forgotten. */
static void clear_screen(Terminal *t, FILE *out) {
    fputs("\033[0m\033[2J", out);
    if (t->protocol == KITTY)
        fputs(hd_kitty_clear, out);
    hd_half_blocks_free(&t->blocks);
    memset(t->lines, 0, sizeof t->lines);
    t->version = -1;
}

static void write_lines(Terminal *t, char lines[HD_VIEW_LINES][HD_VIEW_LINE], FILE *out) {
    const int first = t->rows - t->line_count + 1;
    for (int i = 0; i < t->line_count; i++) {
        if (strcmp(lines[i], t->lines[i]) == 0)
            continue;
        memcpy(t->lines[i], lines[i], HD_VIEW_LINE);
        fprintf(out, "\033[%d;1H\033[%sm%.*s\033[0m\033[K", first + i,
                lines[i][0] == '!' ? "91" : "0", t->columns, lines[i]);
    }
}

static void fit_screen(Terminal *t, int line_count, FILE *out) {
    const int columns = t->columns, rows = t->rows, lines = t->line_count;
    measure(t);
    t->line_count = line_count < t->rows ? line_count : t->rows;
    const HdTextArea area = place_of_picture(t);
    hd_viewer_limit(t->viewer, area.columns * (t->protocol == HALF_BLOCKS ? 1 : t->cell_width));
    if (columns != t->columns || rows != t->rows || lines != t->line_count)
        clear_screen(t, out);
}

static HdStatus draw(Terminal *t, HdError *error) {
    char lines[HD_VIEW_LINES][HD_VIEW_LINE];
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the terminal's picture");
    fit_screen(t, hd_viewer_lines(t->viewer, lines), out);
    HdStatus status = write_picture(t, out, error);
    write_lines(t, lines, out);
    fclose(out);
    if (status == HD_OK)
        status = send_bytes(t, text, size, error);
    free(text);
    return status;
}

/* ---- the loop ---- */

static void wake(void *context) {
    const Terminal *t = context;
    (void)!write(t->wakes[1], "", 1);
}

static void wait_for_more(Terminal *t) {
    char bytes[64];
    const bool is_moving = hd_viewer_is_moving(t->viewer, hd_monotonic_seconds());
    struct pollfd entries[2] = {{.fd = t->file, .events = POLLIN},
                                {.fd = t->wakes[0], .events = POLLIN}};
    poll(entries, 2, is_moving ? MOVING_WAIT_MS : IDLE_WAIT_MS);
    while (read(t->wakes[0], bytes, sizeof bytes) > 0)
        continue;
    if ((entries[0].revents & POLLIN) != 0)
        take_keys(t);
}

static HdStatus run(Terminal *t, HdError *error) {
    HdStatus status = HD_OK;
    while (status == HD_OK && !hd_viewer_has_ended(t->viewer)) {
        wait_for_more(t);
        if (hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted");
        hd_viewer_tick(t->viewer, hd_monotonic_seconds());
        status = draw(t, error);
    }
    return status;
}

/* ---- from open to close ---- */

static void say(void *context, const char *lines) {
    Terminal *t = context;
    if (!isatty(STDOUT_FILENO)) {
        fputs(lines, stdout);
        fflush(stdout);
        return;
    }
    const size_t length = strlen(lines);
    char *said = realloc(t->said, t->said_length + length + 1);
    if (said == NULL)
        return;
    memcpy(said + t->said_length, lines, length + 1);
    t->said = said;
    t->said_length += length;
}

static HdStatus open_terminal(Terminal *t, HdError *error) {
    t->file = open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (t->file < 0)
        return hd_fail(error, HD_UNAVAILABLE,
                       "--terminal needs a terminal, and this program has none (/dev/tty: %s)",
                       strerror(errno));
    if (tcgetattr(t->file, &t->before) != 0)
        return hd_fail(error, HD_UNAVAILABLE, "--terminal needs a terminal: %s", strerror(errno));
    if (pipe(t->wakes) != 0 || fcntl(t->wakes[0], F_SETFL, O_NONBLOCK) != 0 ||
        fcntl(t->wakes[1], F_SETFL, O_NONBLOCK) != 0)
        return hd_fail(error, HD_FAILED, "cannot make a pipe: %s", strerror(errno));
    return HD_OK;
}

static HdStatus take_terminal(Terminal *t, HdError *error) {
    struct termios raw = t->before;
    raw.c_iflag &= ~(tcflag_t)(BRKINT | ICRNL | INPCK | ISTRIP | IXON);
    raw.c_oflag &= ~(tcflag_t)OPOST;
    raw.c_lflag &= ~(tcflag_t)(ECHO | ICANON | IEXTEN | ISIG);
    t->is_raw = true;
    if (tcsetattr(t->file, TCSAFLUSH, &raw) != 0)
        return hd_fail(error, HD_FAILED, "cannot read single keys from the terminal: %s",
                       strerror(errno));
    measure(t);
    HdStatus status = send_text(t, "\033[?1049h\033[?25l\033[2J", error);
    return status == HD_OK ? find_protocol(t, error) : status;
}

/* Before anything is waited for, so that nobody is left with a terminal that does not echo. */
static void give_terminal_back(Terminal *t) {
    HdError ignored;
    if (!t->is_raw)
        return;
    if (t->protocol == KITTY)
        (void)send_text(t, hd_kitty_clear, &ignored);
    (void)send_text(t, "\033[0m\033[?25h\033[?1049l", &ignored);
    tcsetattr(t->file, TCSAFLUSH, &t->before);
}

static void close_terminal(Terminal *t) {
    give_terminal_back(t);
    hd_viewer_close(t->viewer);
    for (int i = 0; i < 2; i++)
        if (t->wakes[i] >= 0)
            close(t->wakes[i]);
    if (t->file >= 0)
        close(t->file);
    if (t->said != NULL)
        fputs(t->said, stdout);
    hd_half_blocks_free(&t->blocks);
    free(t->scaled);
    free(t->said);
}

HdStatus hd_view_in_terminal(const HdViewPlan *plan, HdError *error) {
    Terminal t = {.file = -1, .wakes = {-1, -1}, .version = -1};
    const HdViewHost host = {wake, say, &t};
    HdStatus status = open_terminal(&t, error);
    if (status == HD_OK)
        status = hd_viewer_open(&t.viewer, plan, &host, error);
    if (status == HD_OK)
        status = take_terminal(&t, error);
    if (status == HD_OK)
        status = run(&t, error);
    close_terminal(&t);
    return status;
}
