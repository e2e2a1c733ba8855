/* Checks for the test programs: one line per failure, "N passed, N failed" at the end. */
#ifndef GNOMON_TESTS_CHECK_H
#define GNOMON_TESTS_CHECK_H

#include <math.h>
#include <stdio.h>

static unsigned long check_n_passed, check_n_failed;

static inline int check_note(int ok, const char *file, int line, const char *what)
{
    if (ok) check_n_passed++;
    else {
        check_n_failed++;
        printf("%s:%d: failed: %s\n", file, line, what);
    }
    return ok;
}

static inline int check_int(long long a, long long b, const char *file, int line, const char *what)
{
    char text[400];
    snprintf(text, sizeof text, "%s: %lld, not %lld", what, a, b);
    return check_note(a == b, file, line, text);
}

static inline int check_near(double a, double b, double tolerance, const char *file, int line, const char *what)
{
    char text[400];
    snprintf(text, sizeof text, "%s: %.17g, not %.17g +- %g", what, a, b, tolerance);
    return check_note(fabs(a - b) <= tolerance, file, line, text); /* NaN fails */
}

/* Each is 1 if it held, so that a test can stop where going on makes no sense. */
#define CHECK(condition)            check_note(!!(condition), __FILE__, __LINE__, #condition)
#define CHECK_EQ_INT(a, b)          check_int((long long)(a), (long long)(b), __FILE__, __LINE__, #a)
#define CHECK_NEAR(a, b, tolerance) check_near(a, b, tolerance, __FILE__, __LINE__, #a)

/* The exit status of the program. */
static inline int check_report(void)
{
    printf("%lu passed, %lu failed\n", check_n_passed, check_n_failed);
    return check_n_failed ? 1 : 0;
}

#endif
