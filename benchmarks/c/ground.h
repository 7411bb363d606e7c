/* The ground's motion by rows of laws, each a line or a sine; behind the last one it stands still. */

#include <math.h>

typedef struct {
    double start, end, kind, c0, c1, c2, c3;
} law;

static const law quiet = {0.0, INFINITY, 0.0, 0.0, 0.0, 0.0, 0.0};

static inline double ground_at(const law *g, double t)
{
    double tau = t - g->start;
    if (g->kind == 0.0)
        return g->c0 + g->c1 * tau;
    return g->c0 * sine_of(g->c1 * tau + g->c2);
}

static inline const law *law_at(const law *motion, long n, long *i, double t)
{
    while (*i < n && t >= motion[*i].end)
        ++*i;
    return *i < n ? &motion[*i] : &quiet;
}
