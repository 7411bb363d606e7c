/* The block in x = theta/alpha and time p t; parameters: alpha, radius_ratio. */

#define N 2
#define ROTATION 0
#define RATE 1

#include "sine.h"

typedef struct {
    double alpha, P, Q; /* P = cos(alpha)/alpha, Q = sin(alpha)/alpha */
} constants;

static constants prepare(const double *p)
{
    return (constants){p[0], cos(p[0]) / p[0], sin(p[0]) / p[0]};
}

static inline void rates(double s, const double *y, const constants *c, double a, double *dy)
{
    double sine, cosine;
    sine_cosine(c->alpha * y[0], &sine, &cosine);
    dy[0] = y[1];
    dy[1] = sine * (c->P - s * a * c->Q) - cosine * (a * c->P + s * c->Q);
}

static inline void rates_upright(const double *y, const constants *c, double a, double *dy)
{
    dy[0] = dy[1] = 0.0;
}

/* With both feet down: side s lifts where s times the pull is more than what holds. */
static inline double pull(const double *y, const constants *c, double a)
{
    return -a * c->P;
}

static inline double hold(const constants *c)
{
    return c->Q;
}

static inline double opening(double s, const double *y, const constants *c, double a)
{
    return s * pull(y, c, a) - hold(c);
}

static inline int rebound(int mode, const double *y, double ratio, double *out)
{
    out[0] = 0.0;
    out[1] = ratio * y[1];
    if ((1 - mode) * out[1] > 0.0)
        return 2 - mode;
    out[1] = 0.0;
    return 1;
}

#include PROGRAM
