/* SPDX-License-Identifier: MIT */
#include "view/view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <SDL.h>

#include "system/interrupt.h"
#include "system/machine.h"
#include "view/viewer.h"

/* Smaller scenes get a window of this width at least. */
enum { LEAST_WIDTH = 960, MARGIN = 6, MOVING_WAIT_MS = 4, IDLE_WAIT_MS = 100 };

/* Seconds after which a held arrow glides, and how fast: shares of the picture's width in one. */
#define GLIDE_AFTER 0.2
#define GLIDE       0.3

/* A picture of r, g, b and alpha to write on. */
typedef struct Canvas {
    uint8_t *rgba;
    int width, height;
} Canvas;

typedef struct Window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *picture, *text;
    int picture_width, picture_height, text_width, text_height;
    Canvas canvas; /* of the text; its pixels are owned */
    HdViewer *viewer;
    Uint32 woken;    /* type of the event by which workers wake the window */
    int version;     /* of the picture that is shown */
    bool is_changed; /* something else than the picture is */
    int held;        /* arrow key that is down; 0: none */
    double held_from, glided;
} Window;

/* ---- letters ---- */

enum {
    LETTER_COLUMNS = 5,
    LETTER_ROWS = 9,
    LETTER_WIDTH = 6, /* with the gap that follows */
    LETTER_HEIGHT = 11
};

/* From the top; the left column is the highest of five bits. */
static const uint8_t letters['~' - ' ' + 1][LETTER_ROWS] = {
    [' ' - ' '] = {0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00},
    ['!' - ' '] = {0x04, 0x04, 0x04, 0x04, 0x04, 0x00, 0x04, 0x00, 0x00},
    ['"' - ' '] = {0x0a, 0x0a, 0x0a, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00},
    ['#' - ' '] = {0x0a, 0x0a, 0x1f, 0x0a, 0x1f, 0x0a, 0x0a, 0x00, 0x00},
    ['$' - ' '] = {0x04, 0x0f, 0x14, 0x0e, 0x05, 0x1e, 0x04, 0x00, 0x00},
    ['%' - ' '] = {0x19, 0x19, 0x02, 0x04, 0x08, 0x13, 0x13, 0x00, 0x00},
    ['&' - ' '] = {0x0c, 0x12, 0x14, 0x08, 0x15, 0x12, 0x0d, 0x00, 0x00},
    ['\'' - ' '] = {0x04, 0x04, 0x04, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00},
    ['(' - ' '] = {0x02, 0x04, 0x08, 0x08, 0x08, 0x04, 0x02, 0x00, 0x00},
    [')' - ' '] = {0x08, 0x04, 0x02, 0x02, 0x02, 0x04, 0x08, 0x00, 0x00},
    ['*' - ' '] = {0x00, 0x04, 0x15, 0x0e, 0x15, 0x04, 0x00, 0x00, 0x00},
    ['+' - ' '] = {0x00, 0x04, 0x04, 0x1f, 0x04, 0x04, 0x00, 0x00, 0x00},
    [',' - ' '] = {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c, 0x04, 0x08},
    ['-' - ' '] = {0x00, 0x00, 0x00, 0x1f, 0x00, 0x00, 0x00, 0x00, 0x00},
    ['.' - ' '] = {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c, 0x00, 0x00},
    ['/' - ' '] = {0x00, 0x01, 0x02, 0x04, 0x08, 0x10, 0x00, 0x00, 0x00},
    ['0' - ' '] = {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e, 0x00, 0x00},
    ['1' - ' '] = {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e, 0x00, 0x00},
    ['2' - ' '] = {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f, 0x00, 0x00},
    ['3' - ' '] = {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e, 0x00, 0x00},
    ['4' - ' '] = {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02, 0x00, 0x00},
    ['5' - ' '] = {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e, 0x00, 0x00},
    ['6' - ' '] = {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e, 0x00, 0x00},
    ['7' - ' '] = {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08, 0x00, 0x00},
    ['8' - ' '] = {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e, 0x00, 0x00},
    ['9' - ' '] = {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c, 0x00, 0x00},
    [':' - ' '] = {0x00, 0x0c, 0x0c, 0x00, 0x0c, 0x0c, 0x00, 0x00, 0x00},
    [';' - ' '] = {0x00, 0x00, 0x0c, 0x0c, 0x00, 0x0c, 0x0c, 0x04, 0x08},
    ['<' - ' '] = {0x02, 0x04, 0x08, 0x10, 0x08, 0x04, 0x02, 0x00, 0x00},
    ['=' - ' '] = {0x00, 0x00, 0x1f, 0x00, 0x1f, 0x00, 0x00, 0x00, 0x00},
    ['>' - ' '] = {0x08, 0x04, 0x02, 0x01, 0x02, 0x04, 0x08, 0x00, 0x00},
    ['?' - ' '] = {0x0e, 0x11, 0x01, 0x02, 0x04, 0x00, 0x04, 0x00, 0x00},
    ['@' - ' '] = {0x0e, 0x11, 0x01, 0x0d, 0x15, 0x15, 0x0e, 0x00, 0x00},
    ['A' - ' '] = {0x0e, 0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x00, 0x00},
    ['B' - ' '] = {0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e, 0x00, 0x00},
    ['C' - ' '] = {0x0e, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0e, 0x00, 0x00},
    ['D' - ' '] = {0x1c, 0x12, 0x11, 0x11, 0x11, 0x12, 0x1c, 0x00, 0x00},
    ['E' - ' '] = {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f, 0x00, 0x00},
    ['F' - ' '] = {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x10, 0x00, 0x00},
    ['G' - ' '] = {0x0e, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0f, 0x00, 0x00},
    ['H' - ' '] = {0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11, 0x00, 0x00},
    ['I' - ' '] = {0x0e, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e, 0x00, 0x00},
    ['J' - ' '] = {0x07, 0x02, 0x02, 0x02, 0x02, 0x12, 0x0c, 0x00, 0x00},
    ['K' - ' '] = {0x11, 0x12, 0x14, 0x18, 0x14, 0x12, 0x11, 0x00, 0x00},
    ['L' - ' '] = {0x10, 0x10, 0x10, 0x10, 0x10, 0x10, 0x1f, 0x00, 0x00},
    ['M' - ' '] = {0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11, 0x00, 0x00},
    ['N' - ' '] = {0x11, 0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x00, 0x00},
    ['O' - ' '] = {0x0e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e, 0x00, 0x00},
    ['P' - ' '] = {0x1e, 0x11, 0x11, 0x1e, 0x10, 0x10, 0x10, 0x00, 0x00},
    ['Q' - ' '] = {0x0e, 0x11, 0x11, 0x11, 0x15, 0x12, 0x0d, 0x00, 0x00},
    ['R' - ' '] = {0x1e, 0x11, 0x11, 0x1e, 0x14, 0x12, 0x11, 0x00, 0x00},
    ['S' - ' '] = {0x0f, 0x10, 0x10, 0x0e, 0x01, 0x01, 0x1e, 0x00, 0x00},
    ['T' - ' '] = {0x1f, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04, 0x00, 0x00},
    ['U' - ' '] = {0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e, 0x00, 0x00},
    ['V' - ' '] = {0x11, 0x11, 0x11, 0x11, 0x11, 0x0a, 0x04, 0x00, 0x00},
    ['W' - ' '] = {0x11, 0x11, 0x11, 0x15, 0x15, 0x15, 0x0a, 0x00, 0x00},
    ['X' - ' '] = {0x11, 0x11, 0x0a, 0x04, 0x0a, 0x11, 0x11, 0x00, 0x00},
    ['Y' - ' '] = {0x11, 0x11, 0x11, 0x0a, 0x04, 0x04, 0x04, 0x00, 0x00},
    ['Z' - ' '] = {0x1f, 0x01, 0x02, 0x04, 0x08, 0x10, 0x1f, 0x00, 0x00},
    ['[' - ' '] = {0x0e, 0x08, 0x08, 0x08, 0x08, 0x08, 0x0e, 0x00, 0x00},
    ['\\' - ' '] = {0x00, 0x10, 0x08, 0x04, 0x02, 0x01, 0x00, 0x00, 0x00},
    [']' - ' '] = {0x0e, 0x02, 0x02, 0x02, 0x02, 0x02, 0x0e, 0x00, 0x00},
    ['^' - ' '] = {0x04, 0x0a, 0x11, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00},
    ['_' - ' '] = {0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x1f, 0x00, 0x00},
    ['`' - ' '] = {0x08, 0x04, 0x02, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00},
    ['a' - ' '] = {0x00, 0x00, 0x0e, 0x01, 0x0f, 0x11, 0x0f, 0x00, 0x00},
    ['b' - ' '] = {0x10, 0x10, 0x16, 0x19, 0x11, 0x11, 0x1e, 0x00, 0x00},
    ['c' - ' '] = {0x00, 0x00, 0x0e, 0x10, 0x10, 0x11, 0x0e, 0x00, 0x00},
    ['d' - ' '] = {0x01, 0x01, 0x0d, 0x13, 0x11, 0x11, 0x0f, 0x00, 0x00},
    ['e' - ' '] = {0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e, 0x00, 0x00},
    ['f' - ' '] = {0x06, 0x09, 0x08, 0x1c, 0x08, 0x08, 0x08, 0x00, 0x00},
    ['g' - ' '] = {0x00, 0x00, 0x0f, 0x11, 0x11, 0x11, 0x0f, 0x01, 0x0e},
    ['h' - ' '] = {0x10, 0x10, 0x16, 0x19, 0x11, 0x11, 0x11, 0x00, 0x00},
    ['i' - ' '] = {0x04, 0x00, 0x0c, 0x04, 0x04, 0x04, 0x0e, 0x00, 0x00},
    ['j' - ' '] = {0x02, 0x00, 0x06, 0x02, 0x02, 0x02, 0x02, 0x12, 0x0c},
    ['k' - ' '] = {0x10, 0x10, 0x12, 0x14, 0x18, 0x14, 0x12, 0x00, 0x00},
    ['l' - ' '] = {0x0c, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e, 0x00, 0x00},
    ['m' - ' '] = {0x00, 0x00, 0x1a, 0x15, 0x15, 0x11, 0x11, 0x00, 0x00},
    ['n' - ' '] = {0x00, 0x00, 0x16, 0x19, 0x11, 0x11, 0x11, 0x00, 0x00},
    ['o' - ' '] = {0x00, 0x00, 0x0e, 0x11, 0x11, 0x11, 0x0e, 0x00, 0x00},
    ['p' - ' '] = {0x00, 0x00, 0x1e, 0x11, 0x11, 0x11, 0x1e, 0x10, 0x10},
    ['q' - ' '] = {0x00, 0x00, 0x0f, 0x11, 0x11, 0x11, 0x0f, 0x01, 0x01},
    ['r' - ' '] = {0x00, 0x00, 0x16, 0x19, 0x10, 0x10, 0x10, 0x00, 0x00},
    ['s' - ' '] = {0x00, 0x00, 0x0e, 0x10, 0x0e, 0x01, 0x1e, 0x00, 0x00},
    ['t' - ' '] = {0x08, 0x08, 0x1c, 0x08, 0x08, 0x09, 0x06, 0x00, 0x00},
    ['u' - ' '] = {0x00, 0x00, 0x11, 0x11, 0x11, 0x13, 0x0d, 0x00, 0x00},
    ['v' - ' '] = {0x00, 0x00, 0x11, 0x11, 0x11, 0x0a, 0x04, 0x00, 0x00},
    ['w' - ' '] = {0x00, 0x00, 0x11, 0x11, 0x15, 0x15, 0x0a, 0x00, 0x00},
    ['x' - ' '] = {0x00, 0x00, 0x11, 0x0a, 0x04, 0x0a, 0x11, 0x00, 0x00},
    ['y' - ' '] = {0x00, 0x00, 0x11, 0x11, 0x11, 0x13, 0x0d, 0x01, 0x0e},
    ['z' - ' '] = {0x00, 0x00, 0x1f, 0x02, 0x04, 0x08, 0x1f, 0x00, 0x00},
    ['{' - ' '] = {0x02, 0x04, 0x04, 0x08, 0x04, 0x04, 0x02, 0x00, 0x00},
    ['|' - ' '] = {0x04, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04, 0x00, 0x00},
    ['}' - ' '] = {0x08, 0x04, 0x04, 0x02, 0x04, 0x04, 0x08, 0x00, 0x00},
    ['~' - ' '] = {0x00, 0x00, 0x08, 0x15, 0x02, 0x00, 0x00, 0x00, 0x00},
};

/* Gives a rectangle, cut to the picture, one colour. */
static void fill(const Canvas *canvas, int left, int top, int width, int height,
                 const uint8_t colour[4]) {
    const int right = left + width < canvas->width ? left + width : canvas->width;
    const int bottom = top + height < canvas->height ? top + height : canvas->height;
    for (int y = top > 0 ? top : 0; y < bottom; y++)
        for (int x = left > 0 ? left : 0; x < right; x++)
            memcpy(canvas->rgba + 4 * ((size_t)y * (size_t)canvas->width + (size_t)x), colour, 4);
}

static void write_letter(const Canvas *canvas, char letter, int left, int top, int scale,
                         const uint8_t colour[4]) {
    const uint8_t *rows = letters[(letter < ' ' || letter > '~' ? '?' : letter) - ' '];
    for (int y = 0; y < LETTER_ROWS; y++)
        for (int x = 0; x < LETTER_COLUMNS; x++)
            if ((rows[y] >> (LETTER_COLUMNS - 1 - x) & 1) != 0)
                fill(canvas, left + x * scale, top + y * scale, scale, scale, colour);
}

/* Every pixel of a letter becomes scale x scale pixels. ASCII; anything else is a question mark. */
static void write_text(const Canvas *canvas, const char *text, int left, int top, int scale,
                       const uint8_t colour[4]) {
    for (; *text != '\0'; text++, left += LETTER_WIDTH * scale)
        write_letter(canvas, *text, left, top, scale, colour);
}

/* ---- drawing ---- */

static HdStatus fail(HdError *error, const char *what) {
    return hd_fail(error, HD_FAILED, "%s: %s", what, SDL_GetError());
}

static HdStatus fit_texture(SDL_Renderer *renderer, SDL_Texture **texture, int width, int height,
                            HdError *error) {
    if (*texture != NULL)
        SDL_DestroyTexture(*texture);
    *texture = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STREAMING,
                                 width, height);
    return *texture != NULL ? HD_OK : fail(error, "no room for a picture on the screen");
}

static HdStatus update_picture(Window *w, HdError *error) {
    int version = w->version;
    const HdViewImage *image = hd_viewer_picture(w->viewer, &version);
    HdStatus status = HD_OK;
    if (version == w->version || image->width == 0)
        return HD_OK;
    w->version = version;
    if (image->width != w->picture_width || image->height != w->picture_height) {
        status = fit_texture(w->renderer, &w->picture, image->width, image->height, error);
        w->picture_width = image->width;
        w->picture_height = image->height;
    }
    if (status == HD_OK)
        SDL_UpdateTexture(w->picture, NULL, image->rgba, 4 * image->width);
    return status;
}

/* Beside the edges where the picture has another shape than the window. */
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

static HdStatus fit_text(Window *w, int width, int height, HdError *error) {
    if (width == w->text_width && height == w->text_height)
        return HD_OK;
    uint8_t *rgba = realloc(w->canvas.rgba, 4 * (size_t)width * (size_t)height);
    if (rgba == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for text on the picture");
    w->canvas = (Canvas){rgba, width, height};
    HdStatus status = fit_texture(w->renderer, &w->text, width, height, error);
    if (status == HD_OK)
        SDL_SetTextureBlendMode(w->text, SDL_BLENDMODE_BLEND);
    w->text_width = width;
    w->text_height = height;
    return status;
}

/* Lines on a dark ground, at the top left, or where a split view has room; mistakes in red. */
static HdStatus draw_text(Window *w, int width, int height, HdError *error) {
    static const uint8_t ground[4] = {8, 10, 16, 190}, ink[4] = {235, 240, 245, 255},
                         alarm[4] = {255, 140, 120, 255}, clear[4] = {0, 0, 0, 0};
    char lines[HD_VIEW_LINES][HD_VIEW_LINE];
    const int count = hd_viewer_lines(w->viewer, lines);
    const int scale = width >= 1600 ? 3 : width >= 800 ? 2 : 1;
    const bool is_split = hd_viewer_is_split(w->viewer);
    const int room = is_split ? width / 2 : width;
    const int fitting = scale > 1 && room < HD_VIEW_LINE * LETTER_WIDTH * scale ? scale - 1 : scale;
    const int left = is_split ? width / 2 : 0, top = is_split ? height / 2 : 0;
    HdStatus status = fit_text(w, width, height, error);
    size_t longest = 0;
    if (status != HD_OK)
        return status;
    fill(&w->canvas, 0, 0, width, height, clear);
    for (int i = 0; i < count; i++)
        longest = SDL_strlen(lines[i]) > longest ? SDL_strlen(lines[i]) : longest;
    if (count > 0)
        fill(&w->canvas, left, top, (int)longest * LETTER_WIDTH * fitting + 2 * MARGIN,
             count * LETTER_HEIGHT * fitting + 2 * MARGIN, ground);
    for (int i = 0; i < count; i++)
        write_text(&w->canvas, lines[i], left + MARGIN, top + MARGIN + i * LETTER_HEIGHT * fitting,
                   fitting, lines[i][0] == '!' ? alarm : ink);
    SDL_UpdateTexture(w->text, NULL, w->canvas.rgba, 4 * width);
    return HD_OK;
}

static HdStatus draw(Window *w, HdError *error) {
    int width, height;
    const int before = w->version;
    HdStatus status = update_picture(w, error);
    if (status != HD_OK || (before == w->version && !w->is_changed))
        return status;
    w->is_changed = false;
    SDL_GetRendererOutputSize(w->renderer, &width, &height);
    SDL_SetRenderDrawColor(w->renderer, 0, 0, 0, 255);
    SDL_RenderClear(w->renderer);
    const SDL_Rect place = place_of_picture(w, width, height);
    if (w->picture != NULL)
        SDL_RenderCopy(w->renderer, w->picture, NULL, &place);
    status = draw_text(w, width, height, error);
    if (status == HD_OK)
        SDL_RenderCopy(w->renderer, w->text, NULL, NULL);
    SDL_RenderPresent(w->renderer);
    return status;
}

/* ---- events ---- */

/* Letters come as text, so that they are what the keyboard's layout says; these do not. */
static int special_key(SDL_Keycode key) {
    switch (key) {
    case SDLK_UP:
        return HD_KEY_UP;
    case SDLK_DOWN:
        return HD_KEY_DOWN;
    case SDLK_LEFT:
        return HD_KEY_LEFT;
    case SDLK_RIGHT:
        return HD_KEY_RIGHT;
    case SDLK_TAB:
        return '\t';
    case SDLK_ESCAPE:
        return 27;
    default:
        return 0;
    }
}

static void move_mouse(Window *w, const SDL_MouseMotionEvent *event, double now) {
    int width, height;
    SDL_GetWindowSize(w->window, &width, &height);
    if ((event->state & (SDL_BUTTON_LMASK | SDL_BUTTON_RMASK)) == 0)
        return;
    hd_viewer_drag(w->viewer, (event->state & SDL_BUTTON_RMASK) != 0, (double)event->xrel / width,
                   (double)event->yrel / width, now);
}

/* A held arrow turns the view evenly, at any rate of pictures. */
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
    HdStatus status = HD_OK;
    while (status == HD_OK && !hd_viewer_has_ended(w->viewer)) {
        SDL_Event event;
        const bool is_moving = hd_viewer_is_moving(w->viewer, hd_monotonic_seconds());
        if (SDL_WaitEventTimeout(&event, is_moving ? MOVING_WAIT_MS : IDLE_WAIT_MS) != 0)
            do
                take_event(w, &event);
            while (SDL_PollEvent(&event) != 0);
        if (hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted");
        glide(w, hd_monotonic_seconds());
        hd_viewer_tick(w->viewer, hd_monotonic_seconds());
        status = draw(w, error);
    }
    return status;
}

/* ---- from open to close ---- */

static void wake(void *context) {
    const Window *w = context;
    SDL_Event event = {.type = w->woken};
    SDL_PushEvent(&event);
}

static void say(void *context, const char *lines) {
    (void)context;
    fputs(lines, stdout);
    fflush(stdout);
}

static HdStatus open_window(Window *w, HdError *error) {
    int width, height;
    hd_viewer_size(w->viewer, &width, &height);
    const double scale = width < LEAST_WIDTH ? (double)LEAST_WIDTH / width : 1.0;
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

static HdStatus show(Window *w, const HdViewPlan *plan, HdError *error) {
    const HdViewHost host = {wake, say, w};
    w->is_changed = true;
    HdStatus status = hd_viewer_open(&w->viewer, plan, &host, error);
    if (status == HD_OK)
        status = open_window(w, error);
    if (status == HD_OK)
        status = run(w, error);
    hd_viewer_close(w->viewer);
    return status;
}

/* Where there is no display SDL takes a driver that shows nothing, if it has one. */
static HdStatus open_display(HdError *error) {
    const char *why = SDL_Init(SDL_INIT_VIDEO) != 0 ? SDL_GetError() : NULL;
    const char *driver = why == NULL ? SDL_GetCurrentVideoDriver() : "";
    if (strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0)
        why = "only a driver that shows nothing";
    if (why == NULL)
        return HD_OK;
    return hd_fail(error, HD_UNAVAILABLE,
                   "there is no display to open a window on (SDL: %s); 'hedron view --terminal' "
                   "shows the scene in a terminal",
                   why);
}

HdStatus hd_view_in_window(const HdViewPlan *plan, HdError *error) {
    Window w = {.version = 0};
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
    HdStatus status = open_display(error);
    w.woken = SDL_RegisterEvents(1);
    if (status == HD_OK)
        status = show(&w, plan, error);
    free(w.canvas.rgba);
    SDL_Quit();
    return status;
}
