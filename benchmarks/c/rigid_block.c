/* Rigid block on rigid ground; parameters: mass, half_width, height, inertia, gravity. */

#define N 2
#define ROTATION 0
#define RATE 1

#include "sine.h"

typedef struct {
    double P, Q, gP, gQ; /* m H / I_O, m B / I_O, and times gravity */
} constants;

static constants prepare(const double *p)
{
    double m = p[0], B = p[1], H = p[2], I_O = p[3] + m * (B * B + H * H), g = p[4];
    return (constants){m * H / I_O, m * B / I_O, g * m * H / I_O, g * m * B / I_O};
}

static inline void rates(double s, const double *y, const constants *c, double a, double *dy)
{
    double sine, cosine;
    sine_cosine(y[0], &sine, &cosine);
    dy[0] = y[1];
    dy[1] = sine * (c->gP - s * a * c->Q) - cosine * (a * c->P + s * c->gQ);
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
    return c->gQ;
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
