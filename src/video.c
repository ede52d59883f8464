/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "video.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "atomic_file.h"
#include "interrupt.h"
#include "paths.h"

extern char **environ;

enum {
    MAX_SAID = 4096,
    FOR_EVER = -1,
    /* How long a program that stopped reading may stay silent before it is killed. */
    PATIENCE_MS = 3000,
    GLANCE_MS = 200
};

/* A program at work. It leads a process group of its own, so that Ctrl-C in the terminal reaches
   only us and we decide how the film ends. */
typedef struct Child {
    pid_t pid;  /* 0: none, or waited for */
    int input;  /* its standard input; -1: closed */
    int output; /* its standard output and error; -1: closed */
    size_t said_length;
    char said[MAX_SAID + 1]; /* the end of its output */
} Child;

struct HdVideo {
    Child ffmpeg;
    int width, height;
    long frames;
    char path[HD_MAX_PATH];
    char temporary[HD_MAX_PATH]; /* empty: there is no file */
    char ffprobe[HD_MAX_PATH];
};

static bool is_program(const char *path) {
    struct stat found;
    return stat(path, &found) == 0 && S_ISREG(found.st_mode) && access(path, X_OK) == 0;
}

static HdStatus find_program(const char *name, char out[HD_MAX_PATH], HdError *error) {
    const char *folders = getenv("PATH");
    if (folders == NULL)
        folders = "/usr/local/bin:/usr/bin:/bin";
    for (const char *folder = folders;; folder++) {
        int length = (int)strcspn(folder, ":");
        /* An empty item stands for the current folder. */
        int used = length == 0 ? snprintf(out, HD_MAX_PATH, "./%s", name)
                               : snprintf(out, HD_MAX_PATH, "%.*s/%s", length, folder, name);
        if (used > 0 && used < HD_MAX_PATH && is_program(out))
            return HD_OK;
        folder += length;
        if (*folder == '\0')
            break;
    }
    return hd_fail(error, HD_UNAVAILABLE, "cannot make a film: found no program \"%s\" in PATH",
                   name);
}

static void close_descriptor(int *descriptor) {
    if (*descriptor >= 0)
        close(*descriptor);
    *descriptor = -1;
}

/* Sockets, because writing to a pipe without a reader raises a signal and writing to a socket need
   not. ends[0] is ours. */
static bool open_channel(int ends[2]) {
    return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
}

/* Where our own standard streams are closed, the channels have their numbers. Nothing is
   overwritten before it is used even then: `output` comes after another end and is never 0. */
static int prepare_streams(posix_spawn_file_actions_t *actions, int input, int output) {
    int reason = input >= 0 ? posix_spawn_file_actions_adddup2(actions, input, STDIN_FILENO)
                            : posix_spawn_file_actions_addopen(actions, STDIN_FILENO, "/dev/null",
                                                               O_RDONLY, 0);
    if (reason == 0)
        reason = posix_spawn_file_actions_adddup2(actions, output, STDOUT_FILENO);
    if (reason == 0)
        reason = posix_spawn_file_actions_adddup2(actions, output, STDERR_FILENO);
    return reason;
}

/* The caller may have blocked signals in this thread; the program must not inherit that. */
static int prepare_signals(posix_spawnattr_t *attributes) {
    sigset_t none;
    sigemptyset(&none);
    int reason = posix_spawnattr_setsigmask(attributes, &none);
    if (reason == 0)
        reason = posix_spawnattr_setpgroup(attributes, 0);
    if (reason == 0)
        reason =
            posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    return reason;
}

/* Returns 0 or what went wrong, as errno would. */
static int spawn(pid_t *pid, char *const arguments[], int input, int output) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int reason = posix_spawn_file_actions_init(&actions);
    if (reason != 0)
        return reason;
    reason = posix_spawnattr_init(&attributes);
    if (reason == 0) {
        reason = prepare_streams(&actions, input, output);
        if (reason == 0)
            reason = prepare_signals(&attributes);
        if (reason == 0)
            reason = posix_spawn(pid, arguments[0], &actions, &attributes, arguments, environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    if (reason != 0)
        *pid = 0;
    return reason;
}

static void remember(Child *child, const char *text, size_t length) {
    size_t room = MAX_SAID - child->said_length;
    if (length > room) {
        size_t gone = length - room;
        memmove(child->said, child->said + gone, child->said_length - gone);
        child->said_length -= gone;
    }
    memcpy(child->said + child->said_length, text, length);
    child->said_length += length;
    child->said[child->said_length] = '\0';
}

/* Call only where poll() reported the output; closes it at its end. */
static void take_output(Child *child) {
    char text[1024];
    ssize_t count = read(child->output, text, sizeof text);
    if (count > 0)
        remember(child, text, (size_t)count);
    else if (count == 0 || errno != EINTR)
        close_descriptor(&child->output);
}

/* Takes in output until its end; false where the child is silent for longer than `patience`. */
static bool drain(Child *child, int patience) {
    int waited = 0;
    while (child->output >= 0) {
        if (patience == FOR_EVER && hd_interrupt_signal() != 0)
            return false;
        struct pollfd ready = {.fd = child->output, .events = POLLIN};
        int count = poll(&ready, 1, GLANCE_MS);
        bool failed = count < 0 && errno != EINTR;
        if (count > 0) {
            take_output(child);
            continue;
        }
        waited += GLANCE_MS;
        if (failed || (patience != FOR_EVER && waited >= patience))
            return false;
    }
    return true;
}

/* Sends everything; false where the child no longer reads. Output is taken in meanwhile, so that
   neither side waits for the other for ever. */
static bool send_all(Child *child, const uint8_t *bytes, size_t size) {
    while (size > 0) {
        struct pollfd ready[2] = {{.fd = child->input, .events = POLLOUT},
                                  {.fd = child->output, .events = POLLIN}};
        int count = poll(ready, 2, GLANCE_MS);
        if (hd_interrupt_signal() != 0 || (count < 0 && errno != EINTR))
            return false;
        if (count <= 0)
            continue;
        if (ready[1].revents != 0)
            take_output(child);
        if (ready[0].revents == 0)
            continue;
        ssize_t sent = send(child->input, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
            return false;
        if (sent > 0) {
            bytes += sent;
            size -= (size_t)sent;
        }
    }
    return true;
}

/* Ends the input and waits. Describes in `how` how the program ended; true for exit code 0. */
static bool end_child(Child *child, int patience, char how[64]) {
    int state = 0;
    pid_t ended;
    close_descriptor(&child->input);
    if (!drain(child, patience))
        kill(-child->pid, SIGKILL);
    do
        ended = waitpid(child->pid, &state, 0);
    while (ended < 0 && errno == EINTR);
    child->pid = 0;
    close_descriptor(&child->output);
    if (ended < 0)
        snprintf(how, 64, "exit code unknown: %s", strerror(errno));
    else if (WIFSIGNALED(state))
        snprintf(how, 64, "signal %d", WTERMSIG(state));
    else
        snprintf(how, 64, "exit code %d", WEXITSTATUS(state));
    return ended > 0 && WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

/* The whole group, because "ffmpeg" may be a script that started the real program. */
static void stop_child(Child *child) {
    char how[64];
    if (child->pid > 0) {
        kill(-child->pid, SIGKILL);
        close_descriptor(&child->output);
        end_child(child, FOR_EVER, how);
    }
    close_descriptor(&child->input);
    close_descriptor(&child->output);
}

/* Starts the program arguments[0]. */
static HdStatus start_child(Child *child, char *const arguments[], bool with_input,
                            HdError *error) {
    int input[2] = {-1, -1}, output[2] = {-1, -1};
    bool opened = (!with_input || open_channel(input)) && open_channel(output);
    int reason = opened ? 0 : errno;
    *child = (Child){.input = input[0], .output = output[0]};
    if (opened)
        reason = spawn(&child->pid, arguments, input[1], output[1]);
    close_descriptor(&input[1]);
    close_descriptor(&output[1]);
    if (reason == 0)
        return HD_OK;
    stop_child(child);
    bool unusable = reason == ENOENT || reason == ENOEXEC || reason == EACCES;
    return hd_fail(error, unusable ? HD_UNAVAILABLE : HD_FAILED, "cannot start %s: %s",
                   arguments[0], strerror(reason));
}

/* The last words without line breaks at their end. */
static const char *said(Child *child) {
    while (child->said_length > 0 && strchr("\r\n ", child->said[child->said_length - 1]) != NULL)
        child->said_length--;
    child->said[child->said_length] = '\0';
    return child->said_length > 0 ? child->said : "(nothing)";
}

static HdStatus check_settings(const char *path, int width, int height, int frames_per_second,
                               HdError *error) {
    if (width < 1 || width > HD_MAX_IMAGE_SIDE || height < 1 || height > HD_MAX_IMAGE_SIDE)
        return hd_fail(error, HD_BAD_INPUT, "the film %s has %d x %d pixels, expected 1..%d each",
                       path, width, height, HD_MAX_IMAGE_SIDE);
    if (frames_per_second < 1)
        return hd_fail(error, HD_BAD_INPUT,
                       "the film %s has %d frames a second, expected at least 1", path,
                       frames_per_second);
    return HD_OK;
}

/* "file:" keeps FFmpeg from reading a protocol or an option into the name. */
static HdStatus start_ffmpeg(HdVideo *video, char *ffmpeg, int frames_per_second, HdError *error) {
    char size[32], rate[16], target[HD_MAX_PATH + 8];
    snprintf(size, sizeof size, "%dx%d", video->width, video->height);
    snprintf(rate, sizeof rate, "%d", frames_per_second);
    snprintf(target, sizeof target, "file:%s", video->temporary);
    /* clang-format off */
    char *const arguments[] = {
        ffmpeg, "-nostdin", "-hide_banner", "-nostats", "-loglevel", "error", "-y",
        "-f", "rawvideo", "-pixel_format", "rgba", "-video_size", size, "-framerate", rate,
        "-i", "pipe:0",
        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
        "-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p",
        "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
        "-color_range", "tv", "-movflags", "+faststart", "-f", "mp4", target, NULL};
    /* clang-format on */
    return start_child(&video->ffmpeg, arguments, true, error);
}

static void remove_file(HdVideo *video) {
    if (video->temporary[0] != '\0')
        unlink(video->temporary);
    video->temporary[0] = '\0';
}

/* FFmpeg is given a name that exists: so it is taken against other processes. */
static HdStatus reserve_file(HdVideo *video, HdError *error) {
    int descriptor = -1;
    HdStatus status = hd_temporary_create(video->path, video->temporary, &descriptor, error);
    if (status == HD_OK)
        close(descriptor);
    else
        video->temporary[0] = '\0';
    return status;
}

static HdStatus open_film(HdVideo *video, const char *path, int frames_per_second, HdError *error) {
    char ffmpeg[HD_MAX_PATH];
    HdStatus status = find_program("ffmpeg", ffmpeg, error);
    if (status == HD_OK)
        status = find_program("ffprobe", video->ffprobe, error);
    if (status == HD_OK && strlen(path) >= HD_MAX_PATH)
        status = hd_fail(error, HD_BAD_INPUT,
                         "the name of the film %s is too long, expected fewer than %d bytes", path,
                         HD_MAX_PATH);
    if (status != HD_OK)
        return status;
    memcpy(video->path, path, strlen(path) + 1);
    status = reserve_file(video, error);
    if (status == HD_OK)
        status = start_ffmpeg(video, ffmpeg, frames_per_second, error);
    return status;
}

HdStatus hd_video_open(HdVideo **video, const char *path, int width, int height,
                       int frames_per_second, HdError *error) {
    *video = NULL;
    HdStatus status = check_settings(path, width, height, frames_per_second, error);
    if (status != HD_OK)
        return status;
    HdVideo *film = calloc(1, sizeof *film);
    if (film == NULL)
        return hd_fail(error, HD_FAILED, "not enough memory to make the film %s", path);
    film->width = width;
    film->height = height;
    film->ffmpeg.input = film->ffmpeg.output = -1;
    status = open_film(film, path, frames_per_second, error);
    if (status == HD_OK)
        *video = film;
    else
        hd_video_abort(film);
    return status;
}

static HdStatus fail_interrupted(const HdVideo *video, HdError *error) {
    return hd_fail(error, HD_INTERRUPTED, "interrupted while FFmpeg worked on %s", video->path);
}

static HdStatus fail_early(HdVideo *video, HdError *error) {
    char how[64];
    end_child(&video->ffmpeg, PATIENCE_MS, how);
    return hd_fail(error, HD_FAILED,
                   "FFmpeg ended early (%s) while it was given frame %ld of %s; it said: %s", how,
                   video->frames, video->path, said(&video->ffmpeg));
}

HdStatus hd_video_add(HdVideo *video, const HdImage8 *frame, HdError *error) {
    if (frame->width != video->width || frame->height != video->height)
        return hd_fail(error, HD_BAD_INPUT,
                       "a frame of %d x %d pixels for the film %s, expected %d x %d", frame->width,
                       frame->height, video->path, video->width, video->height);
    if (video->ffmpeg.pid == 0)
        return hd_fail(error, HD_FAILED, "the film %s failed at frame %ld, it takes no more frames",
                       video->path, video->frames);
    if (!send_all(&video->ffmpeg, frame->rgba, (size_t)frame->width * (size_t)frame->height * 4))
        return hd_interrupt_signal() != 0 ? fail_interrupted(video, error)
                                          : fail_early(video, error);
    video->frames++;
    return HD_OK;
}

static HdStatus end_ffmpeg(HdVideo *video, HdError *error) {
    char how[64];
    if (video->ffmpeg.pid == 0)
        return hd_fail(error, HD_FAILED, "the film %s failed at frame %ld", video->path,
                       video->frames);
    if (video->frames == 0)
        return hd_fail(error, HD_FAILED, "the film %s has no frames, expected at least 1",
                       video->path);
    if (end_child(&video->ffmpeg, FOR_EVER, how))
        return HD_OK;
    if (hd_interrupt_signal() != 0)
        return fail_interrupted(video, error);
    return hd_fail(error, HD_FAILED, "FFmpeg could not make %s (%s); it said: %s", video->path, how,
                   said(&video->ffmpeg));
}

/* FFmpeg ends with code 0 even where its input was cut short, so only the file itself tells. */
static HdStatus count_frames(HdVideo *video, HdError *error) {
    char target[HD_MAX_PATH + 8], how[64], *end;
    Child ffprobe;
    snprintf(target, sizeof target, "file:%s", video->temporary);
    /* clang-format off */
    char *const arguments[] = {
        video->ffprobe, "-v", "error", "-select_streams", "v:0", "-count_packets",
        "-show_entries", "stream=nb_read_packets", "-of", "csv=p=0", target, NULL};
    /* clang-format on */
    HdStatus status = start_child(&ffprobe, arguments, false, error);
    if (status != HD_OK)
        return status;
    bool done = end_child(&ffprobe, FOR_EVER, how);
    const char *answer = said(&ffprobe);
    long found = strtol(answer, &end, 10);
    if (!done || *end != '\0')
        return hd_fail(error, HD_FAILED,
                       "ffprobe could not count the frames of %s (%s), expected %ld; it said: %s",
                       video->path, how, video->frames, answer);
    if (found != video->frames)
        return hd_fail(error, HD_FAILED, "FFmpeg wrote %ld frames to %s, expected %ld", found,
                       video->path, video->frames);
    return HD_OK;
}

HdStatus hd_video_close(HdVideo *video, HdError *error) {
    HdStatus status = end_ffmpeg(video, error);
    if (status == HD_OK)
        status = count_frames(video, error);
    if (status == HD_OK) {
        status = hd_temporary_publish(video->temporary, video->path, error);
        video->temporary[0] = '\0';
    }
    hd_video_abort(video);
    return status;
}

void hd_video_abort(HdVideo *video) {
    stop_child(&video->ffmpeg);
    remove_file(video);
    free(video);
}
