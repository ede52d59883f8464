/* SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include <SDL.h>

#include "base/minmax.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "view/viewer.h"

/* Width of the window, at least, for smaller scenes. */
enum { MIN_WIDTH = 960, MARGIN = 6 };

/* Seconds after which a held arrow glides, and its speed in widths of the picture a second. */
#define GLIDE_AFTER 0.2
#define GLIDE       0.3

typedef struct Window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *picture;
    int picture_width, picture_height;
    HdViewer *viewer;
    int version;                             /* number of the shown picture */
    char lines[HD_VIEW_LINES][HD_VIEW_LINE]; /* shown lines */
    int line_count;
    bool is_changed; /* something other than picture and lines changed */
    int held;        /* pressed arrow key; 0: none */
    double held_from, glided;
} Window;

/* ---- letters ---- */

enum {
    LETTER_COLUMNS = 5,
    LETTER_BITS = 9 * LETTER_COLUMNS,
    LETTER_WIDTH = 6, /* with the gap that follows */
    LETTER_HEIGHT = 11
};

/* From space to tilde: 9 rows of 5 bits, the first row in the highest bits. */
static const uint64_t letters[] = {
    0x000000000000, 0x042108401000, 0x0a5280000000, 0x0a57d5f52800, 0x047d1c5f1000, 0x19c88889cc00,
    0x0c9511593400, 0x042100000000, 0x022210820800, 0x082084222000, 0x00255d520000, 0x00213e420000,
    0x000000063088, 0x00003e000000, 0x000000063000, 0x000888880000, 0x0e8ceb98b800, 0x046108423800,
    0x0e8844447c00, 0x1f110418b800, 0x0232a5f10800, 0x1f878218b800, 0x06443d18b800, 0x1f0888842000,
    0x0e8c5d18b800, 0x0e8c5e113000, 0x006300c60000, 0x000318063088, 0x022220820800, 0x0007c1f00000,
    0x082082222000, 0x0e8844401000, 0x0e885b5ab800, 0x0e8c63f8c400, 0x1e8c7d18f800, 0x0e8c2108b800,
    0x1c9463197000, 0x1f843d087c00, 0x1f843d084000, 0x0e8c2f18bc00, 0x118c7f18c400, 0x0e2108423800,
    0x071084293000, 0x119531494400, 0x108421087c00, 0x11dd6b18c400, 0x118e6b38c400, 0x0e8c6318b800,
    0x1e8c7d084000, 0x0e8c63593400, 0x1e8c7d494400, 0x0f841c10f800, 0x1f2108421000, 0x118c6318b800,
    0x118c63151000, 0x118c6b5aa800, 0x118a88a8c400, 0x118c54421000, 0x1f0888887c00, 0x0e4210843800,
    0x008208208000, 0x0e1084213800, 0x045440000000, 0x000000007c00, 0x082080000000, 0x000382f8bc00,
    0x1085b318f800, 0x0003a108b800, 0x010b6718bc00, 0x0003a3f83800, 0x064a38842000, 0x0003e318bc2e,
    0x1085b318c400, 0x040308423800, 0x020184210a4c, 0x1084a98a4800, 0x0c2108423800, 0x0006ab58c400,
    0x0005b318c400, 0x0003a318b800, 0x0007a318fa10, 0x0003e318bc21, 0x0005b3084000, 0x0003a0e0f800,
    0x084710849800, 0x00046319b400, 0x000463151000, 0x0004635aa800, 0x000454454400, 0x00046319b42e,
    0x0007c4447c00, 0x022110420800, 0x042108421000, 0x082104422000, 0x00022a200000,
};

/* Draws each pixel of a letter as scale x scale pixels; a question mark if it is not ASCII. */
static void draw_letter(SDL_Renderer *renderer, char letter, int left, int top, int scale) {
    const uint64_t bits = letters[(letter < ' ' || letter > '~' ? '?' : letter) - ' '];
    SDL_Rect pixels[LETTER_BITS];
    int count = 0;
    for (int i = 0; i < LETTER_BITS; i++)
        if ((bits >> (LETTER_BITS - 1 - i) & 1) != 0)
            pixels[count++] = (SDL_Rect){left + i % LETTER_COLUMNS * scale,
                                         top + i / LETTER_COLUMNS * scale, scale, scale};
    SDL_RenderFillRects(renderer, pixels, count);
}

/* ---- drawing ---- */

static HdStatus fail(HdError *error, const char *what) {
    return hd_fail(error, HD_FAILED, "%s: %s", what, SDL_GetError());
}

static HdStatus update_picture(Window *w, HdError *error) {
    int version = w->version;
    const HdViewImage *image = hd_viewer_picture(w->viewer, &version);
    if (version == w->version || image->width == 0)
        return HD_OK;
    w->version = version;
    if (image->width != w->picture_width || image->height != w->picture_height) {
        if (w->picture != NULL)
            SDL_DestroyTexture(w->picture);
        w->picture = SDL_CreateTexture(w->renderer, SDL_PIXELFORMAT_RGBA32,
                                       SDL_TEXTUREACCESS_STREAMING, image->width, image->height);
        if (w->picture == NULL)
            return fail(error, "the screen has no space for a picture");
        w->picture_width = image->width;
        w->picture_height = image->height;
    }
    SDL_UpdateTexture(w->picture, NULL, image->rgba, 4 * image->width);
    return HD_OK;
}

/* Leaves borders if the picture has another shape than the window. */
static SDL_Rect place_of_picture(const Window *w, int width, int height) {
    int scene_width, scene_height;
    hd_viewer_size(w->viewer, &scene_width, &scene_height);
    SDL_Rect place = {0, 0, width, height};
    if ((double)width * scene_height > (double)height * scene_width)
        place.w = (int)((double)height * scene_width / scene_height);
    else
        place.h = (int)((double)width * scene_height / scene_width);
    place.x = (width - place.w) / 2;
    place.y = (height - place.h) / 2;
    return place;
}

/* Draws lines on a dark ground, at the top left, or in a split view's empty part; errors in red. */
static void draw_text(const Window *w, int width, int height) {
    const int scale = width >= 1600 ? 3 : width >= 800 ? 2 : 1;
    const bool is_split = hd_viewer_is_split(w->viewer);
    const int capacity = is_split ? width / 2 : width;
    const int fitting =
        scale > 1 && capacity < HD_VIEW_LINE * LETTER_WIDTH * scale ? scale - 1 : scale;
    const int across = LETTER_WIDTH * fitting, down = LETTER_HEIGHT * fitting;
    SDL_Rect ground = {is_split ? width / 2 : 0, is_split ? height / 2 : 0, 0,
                       w->line_count * down + 2 * MARGIN};
    for (int i = 0; i < w->line_count; i++)
        ground.w = hd_max(ground.w, (int)strlen(w->lines[i]) * across + 2 * MARGIN);
    SDL_SetRenderDrawBlendMode(w->renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(w->renderer, 8, 10, 16, 190);
    SDL_RenderFillRect(w->renderer, &ground);
    for (int i = 0; i < w->line_count; i++) {
        const char *line = w->lines[i];
        const SDL_Color ink = line[0] == '!' ? (SDL_Color){255, 140, 120, SDL_ALPHA_OPAQUE}
                                             : (SDL_Color){235, 240, 245, SDL_ALPHA_OPAQUE};
        SDL_SetRenderDrawColor(w->renderer, ink.r, ink.g, ink.b, ink.a);
        for (int x = 0; line[x] != '\0'; x++)
            draw_letter(w->renderer, line[x], ground.x + MARGIN + x * across,
                        ground.y + MARGIN + i * down, fitting);
    }
}

/* Replaces the shown lines, and returns whether they differ. */
static bool update_lines(Window *w) {
    char lines[HD_VIEW_LINES][HD_VIEW_LINE] = {{0}};
    w->line_count = hd_viewer_lines(w->viewer, lines);
    const bool is_new = memcmp(lines, w->lines, sizeof lines) != 0;
    memcpy(w->lines, lines, sizeof lines);
    return is_new;
}

static HdStatus draw(Window *w, HdError *error) {
    int width, height;
    const int before = w->version;
    HD_TRY(update_picture(w, error));
    w->is_changed = update_lines(w) || w->is_changed || before != w->version;
    if (!w->is_changed)
        return HD_OK;
    w->is_changed = false;
    SDL_GetRendererOutputSize(w->renderer, &width, &height);
    SDL_SetRenderDrawColor(w->renderer, 0, 0, 0, SDL_ALPHA_OPAQUE);
    SDL_RenderClear(w->renderer);
    const SDL_Rect place = place_of_picture(w, width, height);
    if (w->picture != NULL)
        SDL_RenderCopy(w->renderer, w->picture, NULL, &place);
    draw_text(w, width, height);
    SDL_RenderPresent(w->renderer);
    return HD_OK;
}

/* ---- events ---- */

/* Letters arrive as text, following the keyboard's layout; these keys do not. */
static int special_key(SDL_Keycode key) {
    static const struct {
        SDL_Keycode code;
        int key;
    } keys[] = {{SDLK_UP, HD_KEY_UP},       {SDLK_DOWN, HD_KEY_DOWN}, {SDLK_LEFT, HD_KEY_LEFT},
                {SDLK_RIGHT, HD_KEY_RIGHT}, {SDLK_TAB, '\t'},         {SDLK_ESCAPE, 27}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (keys[i].code == key)
            return keys[i].key;
    return 0;
}

static void move_mouse(Window *w, const SDL_MouseMotionEvent *event, double now) {
    int width, height;
    SDL_GetWindowSize(w->window, &width, &height);
    if ((event->state & (SDL_BUTTON_LMASK | SDL_BUTTON_RMASK)) == 0)
        return;
    hd_viewer_drag(w->viewer, (event->state & SDL_BUTTON_RMASK) != 0, (double)event->xrel / width,
                   (double)event->yrel / width, now);
}

/* A held arrow turns the view evenly, independent of the frame rate. */
static void glide(Window *w, double now) {
    const double start = w->held_from + GLIDE_AFTER;
    const double step = GLIDE * (now - (w->glided > start ? w->glided : start));
    if (w->held == 0 || now < start)
        return;
    const int right = (w->held == HD_KEY_LEFT) - (w->held == HD_KEY_RIGHT);
    const int down = (w->held == HD_KEY_UP) - (w->held == HD_KEY_DOWN);
    w->glided = now;
    hd_viewer_drag(w->viewer, false, right * step, down * step, now);
}

static void press_key(Window *w, const SDL_KeyboardEvent *event, double now) {
    const int key = special_key(event->keysym.sym);
    if (key == 0 || event->repeat != 0)
        return;
    w->held = key >= HD_KEY_UP ? key : 0;
    w->held_from = now;
    hd_viewer_key(w->viewer, key, now);
}

static void take_event(Window *w, const SDL_Event *event) {
    const double now = hd_monotonic_seconds();
    w->is_changed = w->is_changed || event->type != SDL_MOUSEMOTION;
    if (event->type == SDL_QUIT)
        hd_viewer_key(w->viewer, 'q', now);
    else if (event->type == SDL_KEYDOWN)
        press_key(w, &event->key, now);
    else if (event->type == SDL_KEYUP && special_key(event->key.keysym.sym) == w->held)
        w->held = 0;
    else if (event->type == SDL_TEXTINPUT)
        hd_viewer_key(w->viewer, (unsigned char)event->text.text[0], now);
    else if (event->type == SDL_MOUSEMOTION)
        move_mouse(w, &event->motion, now);
    else if (event->type == SDL_MOUSEWHEEL && event->wheel.y != 0)
        hd_viewer_key(w->viewer, event->wheel.y > 0 ? '+' : '-', now);
}

static HdStatus run(Window *w, HdError *error) {
    while (hd_viewer_tick(w->viewer, hd_monotonic_seconds())) {
        HD_TRY(draw(w, error));
        SDL_Event event;
        if (SDL_WaitEventTimeout(&event, hd_viewer_wait_ms(w->viewer)) != 0)
            do
                take_event(w, &event);
            while (SDL_PollEvent(&event) != 0);
        if (hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted");
        glide(w, hd_monotonic_seconds());
    }
    return HD_OK;
}

/* ---- open and close ---- */

static HdStatus open_window(Window *w, HdError *error) {
    int width, height;
    hd_viewer_size(w->viewer, &width, &height);
    const double scale = width < MIN_WIDTH ? (double)MIN_WIDTH / width : 1.0;
    w->window = SDL_CreateWindow("hedron", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                 (int)(scale * width), (int)(scale * height), SDL_WINDOW_RESIZABLE);
    if (w->window == NULL)
        return fail(error, "cannot open a window");
    w->renderer = SDL_CreateRenderer(w->window, -1, 0);
    if (w->renderer == NULL)
        return fail(error, "cannot draw in a window");
    SDL_StartTextInput();
    return HD_OK;
}

/* Without a display SDL uses a driver that shows nothing, if it has one. */
static HdStatus open_display(HdError *error) {
    const char *why = SDL_Init(SDL_INIT_VIDEO) != 0 ? SDL_GetError() : NULL;
    const char *driver = why == NULL ? SDL_GetCurrentVideoDriver() : "";
    if (strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0 ||
        strcmp(driver, "evdev") == 0)
        why = "only a driver that shows nothing";
    if (why == NULL)
        return HD_OK;
    return hd_fail(error, HD_UNAVAILABLE,
                   "there is no display to open a window on (SDL: %s); 'hedron view --terminal' "
                   "shows the scene in a terminal",
                   why);
}

HdStatus hd_view_in_window(const HdScenePlan *scene, const HdDevicePlan *devices, HdError *error) {
    Window w = {.is_changed = true};
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
    HdStatus status = open_display(error);
    if (status == HD_OK)
        status = hd_viewer_open(&w.viewer, scene, devices, stdout, error);
    if (status == HD_OK)
        status = open_window(&w, error);
    if (status == HD_OK)
        status = run(&w, error);
    hd_viewer_close(w.viewer);
    SDL_Quit();
    return status;
}
