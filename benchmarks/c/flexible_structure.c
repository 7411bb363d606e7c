/* Two masses, a flexible column, rigid ground; parameters: mass, height, inertia, base_mass,
 * base_height, base_inertia, half_width, gravity, stiffness, damping.
 *
 * In axes that turn with the base, w = u - s B beside the pivot, the second equation
 *   H theta'' + u'' = F = w theta'^2 + g sin - a cos - (k u + c u')/m
 * takes u'' out of the first, which leaves
 *   (J + m w^2) theta'' = g (S sin + W cos) - a (S cos - W sin) - 2 m w u' theta' - m H F
 * with S = m H + m_b H_b, W = m w - s m_b B: one division a call.
 */

#define N 4
#define ROTATION 0
#define RATE 2

#include "sine.h"

typedef struct {
    double m, H, mH, J, S, B, mbB, g, k_m, c_m;
} constants;

static constants prepare(const double *p)
{
    double m = p[0], H = p[1], mb = p[3], Hb = p[4], B = p[6];
    double J = p[2] + p[5] + mb * (Hb * Hb + B * B);
    return (constants){m, H, m * H, J, m * H + mb * Hb, B, mb * B, p[7], p[8] / m, p[9] / m};
}

static inline void rates(double s, const double *y, const constants *c, double a, double *dy)
{
    double sine, cosine;
    sine_cosine(y[0], &sine, &cosine);
    double u = y[1], theta_dot = y[2], u_dot = y[3];
    double w = u - s * c->B, mw = c->m * w, W = mw - s * c->mbB;
    double along = c->g * sine - a * cosine, across = c->g * cosine + a * sine;
    double F = w * theta_dot * theta_dot + along - c->k_m * u - c->c_m * u_dot;
    double moment = c->S * along + W * across - 2.0 * mw * u_dot * theta_dot - c->mH * F;
    double theta_ddot = moment / (c->J + mw * w);
    dy[0] = theta_dot;
    dy[1] = u_dot;
    dy[2] = theta_ddot;
    dy[3] = F - c->H * theta_ddot;
}

static inline void rates_upright(const double *y, const constants *c, double a, double *dy)
{
    dy[0] = dy[2] = 0.0;
    dy[1] = y[3];
    dy[3] = -a - c->k_m * y[1] - c->c_m * y[3];
}

/* With both feet down: side s lifts where s times the pull is more than what holds. */
static inline double pull(const double *y, const constants *c, double a)
{
    double F = -a - c->k_m * y[1] - c->c_m * y[3];
    return c->g * c->m * y[1] - c->S * a - c->mH * F;
}

static inline double hold(const constants *c)
{
    return c->g * (c->m * c->B + c->mbB);
}

static inline double opening(double s, const double *y, const constants *c, double a)
{
    double w = y[1] - s * c->B;
    return (s * pull(y, c, a) - hold(c)) / (c->J + c->m * w * w);
}

static inline int rebound(int mode, const double *y, double ratio, double *out)
{
    out[0] = 0.0;
    out[1] = y[1];
    out[2] = ratio * y[2];
    out[3] = y[3];
    if ((1 - mode) * out[2] > 0.0)
        return 2 - mode;
    out[2] = 0.0;
    return 1;
}

#include PROGRAM
