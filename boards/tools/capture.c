/* capture SECONDS TEXT OUT.ppm EMULATOR ARGUMENT...: runs the emulator, waits until the firmware has printed TEXT, has
 * the emulator's monitor write what is on the screen to OUT.ppm, and ends it. What the firmware prints goes to stdout.
 * Exit status 0: the picture is there; 1: it is not, and stderr says why; 2: usage. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static const char prompt[] = "(qemu) ";

typedef struct {
    pid_t emulator;
    int to_monitor, from[2]; /* 0: the monitor's answers (stdout), 1: the firmware's console (stderr) */
    char text[2][1 << 16];   /* what came so far, with a 0 behind it */
    size_t n[2];
    time_t end;
} session;

static int fail(const char *what)
{
    fprintf(stderr, "capture: %s\n", what);
    return -1;
}

/* ---- The emulator ------------------------------------------------------------------------------------------------ */

static void run_emulator(char **arguments, int n_arguments, int in, int out, int err)
{
    static char *line[64];
    char *const more[] = {"-display", "none", "-serial", "none", "-monitor", "stdio"};
    int n = 0;
    for (int i = 0; i < n_arguments; i++) line[n++] = arguments[i];
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) line[n++] = more[i];
    dup2(in, 0);
    dup2(out, 1);
    dup2(err, 2);
    execvp(line[0], line);
    _exit(127);
}

static int start(session *s, char **arguments, int n_arguments)
{
    int in[2], out[2], err[2];
    if (n_arguments > 50 || pipe(in) || pipe(out) || pipe(err)) return fail("cannot begin");
    s->emulator = fork();
    if (s->emulator < 0) return fail("cannot begin");
    if (s->emulator == 0) {
        close(in[1]);
        close(out[0]);
        close(err[0]);
        run_emulator(arguments, n_arguments, in[0], out[1], err[1]);
    }
    close(in[0]);
    close(out[1]);
    close(err[1]);
    s->to_monitor = in[1];
    s->from[0] = out[0];
    s->from[1] = err[0];
    return 0;
}

/* ---- Listening --------------------------------------------------------------------------------------------------- */

static int take(session *s, int which)
{
    size_t room = sizeof s->text[which] - 1 - s->n[which];
    ssize_t n = room ? read(s->from[which], s->text[which] + s->n[which], room) : -1;
    if (n <= 0) return fail(room ? "the emulator ended" : "the emulator talks too much");
    if (which == 1) fwrite(s->text[1] + s->n[1], 1, (size_t)n, stdout);
    s->n[which] += (size_t)n;
    s->text[which][s->n[which]] = '\0';
    return 0;
}

/* Until `text` has come from the monitor (0) or the console (1), after the first `from` bytes. */
static int await(session *s, int which, const char *text, size_t from)
{
    while (!strstr(s->text[which] + from, text)) {
        struct pollfd fds[2] = {{.fd = s->from[0], .events = POLLIN}, {.fd = s->from[1], .events = POLLIN}};
        time_t now = time(NULL);
        if (now >= s->end) return fail(which ? "the firmware did not say it" : "the monitor did not answer");
        if (poll(fds, 2, (int)(s->end - now) * 1000) < 0 && errno != EINTR) return fail("cannot listen");
        for (int i = 0; i < 2; i++)
            if (fds[i].revents && take(s, i)) return -1;
    }
    return 0;
}

static int tell(session *s, const char *command, const char *argument)
{
    char line[600];
    int n = snprintf(line, sizeof line, "%s %s\n", command, argument);
    if (n < 0 || (size_t)n >= sizeof line || write(s->to_monitor, line, (size_t)n) != n)
        return fail("the monitor does not listen");
    return 0;
}

static int capture(session *s, const char *text, const char *path)
{
    if (await(s, 1, text, 0) || await(s, 0, prompt, 0)) return -1;
    size_t from = s->n[0];
    if (tell(s, "screendump", path) || await(s, 0, prompt, from)) return -1;
    return access(path, R_OK) ? fail(s->text[0] + from) : 0;
}

int main(int argc, char **argv)
{
    static session s;
    if (argc < 5) {
        fprintf(stderr, "usage: capture SECONDS TEXT OUT.ppm EMULATOR ARGUMENT...\n");
        return 2;
    }
    signal(SIGPIPE, SIG_IGN);
    remove(argv[3]);
    s.end = time(NULL) + atoi(argv[1]);
    if (start(&s, argv + 4, argc - 4)) return 1;
    int failed = capture(&s, argv[2], argv[3]);
    if (s.n[1] > 0 && s.text[1][s.n[1] - 1] != '\n') putchar('\n');
    kill(s.emulator, SIGKILL);
    waitpid(s.emulator, NULL, 0);
    return failed != 0;
}
