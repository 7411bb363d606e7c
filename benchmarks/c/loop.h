/* The integration loop by hand: the same method as rockeom's, step for step.
 *
 * A structure's file defines N, ROTATION, RATE (places in the state), `constants`, and
 *
 *   rates(s, y, c, a, dy)          rocking about the foot of side s = -1, +1, under acceleration a
 *   rates_upright(y, c, a, dy)     both feet on the ground
 *   opening(s, y, c, a)            acceleration with which side s would open from rest
 *   rebound(s, y, ratio, out)      state after the impact that closes side s
 *
 * and then includes this file. Eighth order of Dormand and Prince, the errors of order 5 and 3,
 * dense output of degree 7; its sums come from a header written out of the tableau.
 */

#include <math.h>
#include <string.h>

#include "ground.h"
#include "method.h"

enum { COMPLETED, CAME_TO_REST, OVERTURNED, TOO_MANY_IMPACTS, STALLED, CHATTER, NOT_FINITE, FULL };
enum { IMPACT, UPLIFT, SWITCH, REST };

#define EPS 2.220446049250313e-16
#define NEVER 2.0
#define UPRIGHT 1 /* modes are 0 left, 1 both, 2 right: the side is mode - 1 */
#define STAGES 12
#define ALL_STAGES 16

/* -- one step --------------------------------------------------------------------------------- */

static inline void rate(int mode, const double *y, const constants *c, const law *g, double t,
                        double *dy)
{
    double a = ground_at(g, t);
    if (mode == UPRIGHT)
        rates_upright(y, c, a, dy);
    else
        rates(mode - 1.0, y, c, a, dy);
}

#define STAGE(j)                                                                                   \
    for (int i = 0; i < N; ++i)                                                                    \
        w[i] = y[i] + h * SUM_##j(i);                                                              \
    rate(mode, w, c, g, t + C_##j * h, k[j])

/* k[0] is the rate at y and k[STAGES] that at the new state; returns the error, 1 at tolerance. */
static inline double take_step(int mode, double t, double h, const double *restrict y,
                               const constants *restrict c, const law *restrict g, double rtol,
                               double atol, double (*restrict k)[N], double *restrict y_new)
{
    double w[N];
    STAGE(1);
    STAGE(2);
    STAGE(3);
    STAGE(4);
    STAGE(5);
    STAGE(6);
    STAGE(7);
    STAGE(8);
    STAGE(9);
    STAGE(10);
    STAGE(11);
    for (int i = 0; i < N; ++i)
        y_new[i] = y[i] + h * SUM_12(i);
    rate(mode, y_new, c, g, t + h, k[STAGES]);
    double s5 = 0.0, s3 = 0.0;
    for (int i = 0; i < N; ++i) {
        double scale = 1.0 / (atol + rtol * fmax(fabs(y[i]), fabs(y_new[i])));
        double e5 = ERROR_5(i) * scale, e3 = ERROR_3(i) * scale;
        s5 += e5 * e5;
        s3 += e3 * e3;
    }
    if (s5 == 0.0 && s3 == 0.0)
        return 0.0;
    return fabs(h) * s5 / sqrt((s5 + 0.01 * s3) * N);
}

static void dense_output(int mode, double t, double h, const double *restrict y,
                         const constants *restrict c, const law *restrict g,
                         double (*restrict k)[N], double (*restrict poly)[N])
{
    double w[N];
    STAGE(13);
    STAGE(14);
    STAGE(15);
    for (int i = 0; i < N; ++i) {
        poly[0][i] = y[i];
        poly[1][i] = h * DENSE_1(i);
        poly[2][i] = h * DENSE_2(i);
        poly[3][i] = h * DENSE_3(i);
        poly[4][i] = h * DENSE_4(i);
        poly[5][i] = h * DENSE_5(i);
        poly[6][i] = h * DENSE_6(i);
        poly[7][i] = h * DENSE_7(i);
    }
}

static inline double dense_at(double (*poly)[N], double x, int i)
{
    double value = poly[7][i];
    for (int j = 6; j >= 0; --j)
        value = value * x + poly[j][i];
    return value;
}

/* -- first fall of a guard through zero -------------------------------------------------------- */

/* Value, and slope at x, of the polynomial with these Bernstein coefficients. */
static inline double bernstein_at(const double *b, double x, double *slope)
{
    double w[8];
    memcpy(w, b, sizeof w);
#pragma GCC unroll 8
    for (int n = 7; n > 1; --n)
#pragma GCC unroll 8
        for (int i = 0; i < n; ++i)
            w[i] += x * (w[i + 1] - w[i]);
    *slope = 7.0 * (w[1] - w[0]);
    return w[0] + x * (w[1] - w[0]);
}

static inline double size(const double *b)
{
    double largest = 0.0;
    for (int i = 0; i < 8; ++i)
        largest = fmax(largest, fabs(b[i]));
    return largest;
}

/* The single fall through zero on [0, 1], by Newton's method within a bracket. */
static double fall(const double *b)
{
    double low = 0.0, high = 1.0, x = 0.5;
    if (b[0] > 0.0 && 0.0 > b[7])
        x = b[0] / (b[0] - b[7]);
    for (int n = 0; n < 200; ++n) {
        double slope, value = bernstein_at(b, x, &slope);
        if (value > 0.0)
            low = x;
        else
            high = x;
        double step = slope < 0.0 ? -value / slope : INFINITY;
        x += step;
        if (fabs(step) <= EPS || high - low <= 2.0 * EPS)
            break;
        if (!(low < x && x < high) || n % 8 == 7)
            x = 0.5 * (low + high);
    }
    return fmin(fmax(x, low), high);
}

/* Smallest x in (0, 1] at which the polynomial falls through zero, or NEVER: parts are halved until
 * the changes of sign of their coefficients leave no doubt. */
static double first_fall(const double *b, int closed, double noise)
{
    struct {
        double b[8], start, width;
    } stack[64];
    double scale = size(b);
    if (scale == 0.0)
        return NEVER;
    noise = fmax(8.0 * EPS * scale, noise);
    memcpy(stack[0].b, b, sizeof stack[0].b);
    if (closed)
        stack[0].b[0] = 0.0;
    stack[0].start = 0.0;
    stack[0].width = 1.0;
    int depth = 0;
    while (depth >= 0) {
        double *part = stack[depth].b, *lower = stack[depth + 1].b;
        double start = stack[depth].start, width = stack[depth].width;
        int changes = 0, first = 0, sign = 0;
        for (int i = 0; i < 8; ++i)
            if (fabs(part[i]) > noise) {
                int now = part[i] > 0.0 ? 1 : -1;
                if (sign == 0)
                    first = now;
                else if (now != sign)
                    ++changes;
                sign = now;
            }
        if (changes == 0) {
            if (first < 0 && (start > 0.0 || closed || depth == 0))
                return start;
            --depth;
        } else if (changes == 1 || width < 1e-13) {
            if (first > 0)
                return start + width * fall(part);
            if (closed && start == 0.0)
                return 0.0;
            --depth;
        } else {
            for (int n = 7; n >= 0; --n) {
                lower[7 - n] = part[0];
                for (int i = 0; i < n; ++i)
                    part[i] = 0.5 * (part[i] + part[i + 1]);
            }
            stack[depth + 1].start = start;
            stack[depth + 1].width = stack[depth].width = 0.5 * width;
            stack[depth].start = start + 0.5 * width;
            ++depth;
        }
    }
    return NEVER;
}

/* Whether the gap clearly stays open: the quintic through both ends, in Bernstein form. */
static inline int stays_open(double s, double h, const double *y, const double *y_new,
                             double (*k)[N], int closed)
{
    double q0 = s * y[ROTATION], q1 = s * y_new[ROTATION];
    double v0 = s * h * y[RATE] / 5.0, v1 = s * h * y_new[RATE] / 5.0;
    double a0 = s * h * h * k[0][RATE] / 20.0, a1 = s * h * h * k[STAGES][RATE] / 20.0;
    double least = 1e-3 * fmax(q0, q1);
    return (q0 > least || closed) && q0 + v0 > least && q0 + 2.0 * v0 + a0 > least &&
           q1 - 2.0 * v1 + a1 > least && q1 - v1 > least && q1 > least;
}

/* Whether both feet clearly stay on the ground: their guards on the quintics through both ends. */
static int stays_held(double t, double h, const double *y, const double *y_new, double (*k)[N],
                      const constants *c, const law *g)
{
    double q[N / 2][6], b[2][8];
    for (int i = 0; i < N / 2; ++i) {
        double v0 = h * y[N / 2 + i] / 5.0, v1 = h * y_new[N / 2 + i] / 5.0;
        double a0 = h * h * k[0][N / 2 + i] / 20.0, a1 = h * h * k[STAGES][N / 2 + i] / 20.0;
        q[i][0] = y[i];
        q[i][1] = y[i] + v0;
        q[i][2] = y[i] + 2.0 * v0 + a0;
        q[i][3] = y_new[i] - 2.0 * v1 + a1;
        q[i][4] = y_new[i] - v1;
        q[i][5] = y_new[i];
    }
    memset(b, 0, sizeof b);
    for (int m = 0; m < 8; ++m) {
        double w[N];
        for (int i = 0; i < N / 2; ++i) {
            double value = 0.0, slope = 0.0;
            for (int j = 0; j < 6; ++j)
                value += QUINTIC[m][j] * q[i][j];
            for (int j = 0; j < 5; ++j)
                slope += QUARTIC[m][j] * (q[i][j + 1] - q[i][j]);
            w[i] = value;
            w[N / 2 + i] = slope * (5.0 / h);
        }
        double a = ground_at(g, t + NODES[m] * h);
        double left = -opening(-1.0, w, c, a), right = -opening(1.0, w, c, a);
        for (int i = 0; i < 8; ++i) {
            b[0][i] += SAMPLES_TO_BERNSTEIN[i][m] * left;
            b[1][i] += SAMPLES_TO_BERNSTEIN[i][m] * right;
        }
    }
    for (int side = 0; side < 2; ++side) {
        double least = b[side][0], most = fabs(b[side][0]);
        for (int i = 1; i < 8; ++i) {
            least = fmin(least, b[side][i]);
            most = fmax(most, fabs(b[side][i]));
        }
        if (!(least > 1e-3 * most))
            return 0;
    }
    return 1;
}

/* Bernstein coefficients of the guards of a mode over a step; returns their number. */
static int guard_polynomials(int mode, double t, double h, const constants *c, const law *g,
                             double (*poly)[N], double (*b)[8])
{
    if (mode != UPRIGHT) {
        double s = mode - 1.0;
        for (int i = 0; i < 8; ++i) {
            b[0][i] = 0.0;
            for (int j = 0; j <= i; ++j)
                b[0][i] += POWERS_TO_BERNSTEIN[i][j] * (s * poly[j][ROTATION]);
        }
        return 1;
    }
    memset(b, 0, 2 * sizeof *b);
    for (int m = 0; m < 8; ++m) {
        double w[N];
        for (int i = 0; i < N; ++i)
            w[i] = dense_at(poly, NODES[m], i);
        double a = ground_at(g, t + NODES[m] * h);
        double left = -opening(-1.0, w, c, a), right = -opening(1.0, w, c, a);
        for (int i = 0; i < 8; ++i) {
            b[0][i] += SAMPLES_TO_BERNSTEIN[i][m] * left;
            b[1][i] += SAMPLES_TO_BERNSTEIN[i][m] * right;
        }
    }
    return 2;
}

static double rounding(int mode, double h, const double *y, const constants *c, const law *g,
                       double t, const double *b)
{
    if (mode == UPRIGHT)
        return 1e-8 * size(b);
    double a = ground_at(g, t);
    double acceleration = fabs(opening(-1.0, y, c, a)) + fabs(opening(1.0, y, c, a));
    return fmax(1e-11 * size(b), 1e-10 * acceleration * h * h);
}

/* Whether |rotation| may turn inside a step above the largest so far: the quintic bounds it. */
static inline int may_crest(double h, const double *y, const double *y_new, double (*k)[N],
                            double peak)
{
    double v0 = h * y[RATE] / 5.0, v1 = h * y_new[RATE] / 5.0;
    if (!(v0 * v1 < 0.0))
        return 0;
    double q0 = y[ROTATION], a0 = h * h * k[0][RATE] / 20.0;
    double q1 = y_new[ROTATION], a1 = h * h * k[STAGES][RATE] / 20.0;
    double b2 = fabs(q0 + 2.0 * v0 + a0), b3 = fabs(q1 - 2.0 * v1 + a1);
    return 1.001 * fmax(fmax(fabs(q0 + v0), fabs(q1 - v1)), fmax(b2, b3)) > peak;
}

/* Largest |rotation| inside a step in which the rate changes its sign, by Newton's method on the
 * slope of the dense output, kept in its bracket. */
static double crest(double (*poly)[N])
{
    double low = 0.0, high = 1.0, x = 0.5, rising = poly[1][ROTATION];
    for (int n = 0; n < 60; ++n) {
        double slope = 7.0 * poly[7][ROTATION], bend = 42.0 * poly[7][ROTATION];
        for (int j = 6; j > 0; --j)
            slope = slope * x + j * poly[j][ROTATION];
        for (int j = 6; j > 1; --j)
            bend = bend * x + j * (j - 1) * poly[j][ROTATION];
        if ((slope > 0.0) == (rising > 0.0))
            low = x;
        else
            high = x;
        double next = x - slope / bend;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (fabs(next - x) < 1e-9) /* the value is flat there */
            break;
        x = next;
    }
    return fabs(dense_at(poly, x, ROTATION));
}

/* -- infinitely many impacts ------------------------------------------------------------------- */

static double time_to_rest(int mode, const double *y, const constants *c, double ratio,
                           const law *g, double t, double tolerance, double *out, int *follows)
{
    double w[N], total = 0.0, start = fabs(y[RATE]), a = ground_at(g, t);
    memcpy(w, y, sizeof w);
    for (;;) {
        rates(mode - 1.0, w, c, a, out);
        double closing = (1.0 - mode) * out[RATE];
        if (!(closing > 0.0))
            return INFINITY;
        double v = fabs(w[RATE]), flight = 2.0 * v / closing;
        total += flight;
        if (total * total * closing > tolerance * tolerance)
            return INFINITY;
        for (int i = 0; i < N; ++i)
            w[i] += flight * out[i];
        w[ROTATION] = 0.0;
        if (v <= EPS * start)
            w[RATE] = 0.0;
        mode = rebound(mode, w, ratio, out);
        if (mode == UPRIGHT) {
            *follows = mode;
            return total;
        }
        if (!(fabs(out[RATE]) < v))
            return INFINITY;
        memcpy(w, out, sizeof w);
    }
}

/* -- the loop ---------------------------------------------------------------------------------- */

typedef struct {
    double rtol, atol, fallen, rest_tolerance, ratio;
    long max_impacts, max_steps;
} options;

typedef struct {
    double time;
    long kind, before, after;
    double from[N], to[N];
} event;

typedef struct {
    double t, h_next, peak, y[N];
    long mode, closed, impacts, taken, accepted, n_events;
} state;

static inline void record(event *e, double t, long kind, long before, long after, const double *y,
                          const double *to)
{
    e->time = t;
    e->kind = kind;
    e->before = before;
    e->after = after;
    memcpy(e->from, y, sizeof e->from);
    memcpy(e->to, to, sizeof e->to);
}

static double first_step(const double *y, const double *dy, double rtol, double atol)
{
    double size = 0.0, speed = 0.0;
    for (int i = 0; i < N; ++i) {
        double scale = atol + rtol * fabs(y[i]);
        size = fmax(size, fabs(y[i]) / scale);
        speed = fmax(speed, fabs(dy[i]) / scale);
    }
    return size < 1e-5 || speed < 1e-5 ? 1e-6 : 0.01 * size / speed;
}

/* The foot that lifts at once and stays lifted, 0 or 1, from both feet on the ground; or -1. */
static int settle(double t, double h, const double *y, const constants *c, const law *g,
                  int closed)
{
    double a = ground_at(g, t);
    int left = closed != 0 && opening(-1.0, y, c, a) > 0.0;
    int right = closed != 1 && opening(1.0, y, c, a) > 0.0;
    if (!left && !right)
        return -1;
    double dy[N], w[N], tau = 64.0 * EPS * fmax(t, h);
    rates_upright(y, c, a, dy);
    for (int i = 0; i < N; ++i)
        w[i] = y[i] + tau * dy[i];
    a = ground_at(g, t + tau);
    double up_left = opening(-1.0, w, c, a), up_right = opening(1.0, w, c, a);
    left = left && up_left > 0.0;
    right = right && up_right > 0.0;
    return right && (!left || up_right > up_left) ? 1 : left ? 0 : -1;
}

/* Integrate to t_end or to an outcome; with_peak follows the largest |rotation| as well. */
static inline int integrate(state *st, double t_end, const law *motion, long n_laws,
                            const constants *c, const options *o, event *events, long max_events,
                            const int with_peak)
{
    double k[ALL_STAGES][N], y[N], y_new[N], after[N], poly[8][N], b[2][8];
    int mode = st->mode, closed = st->closed, fresh = 1, idle = 0, outcome = COMPLETED;
    long taken = st->taken, accepted = st->accepted, impacts = st->impacts;
    long n_events = st->n_events, i_law = 0;
    double t = st->t, h_next = st->h_next, peak = st->peak, last_error = 0.0;
    const double rtol = o->rtol, atol = o->atol;
    memcpy(y, st->y, sizeof y);
    memset(k, 0, sizeof k);
    const law *g = law_at(motion, n_laws, &i_law, t);

    while (t < t_end) {
        if (n_events + 2 > max_events) {
            outcome = FULL;
            break;
        }
        if (t >= g->end) {
            double before = ground_at(g, t), after;
            g = law_at(motion, n_laws, &i_law, t);
            after = ground_at(g, t);
            if (fabs(after - before) > 1e-10 * (fabs(before) + fabs(after)))
                fresh = 1; /* the ground jumps: so do the rates */
        }
        double last = fmin(g->end, t_end);
        int landed = -1;
        if (fresh) {
            if (mode == UPRIGHT)
                landed = settle(t, h_next, y, c, g, closed);
            if (landed < 0) {
                rate(mode, y, c, g, t, k[0]);
                fresh = 0;
                if (h_next == 0.0)
                    h_next = first_step(y, k[0], rtol, atol);
            }
        }

        if (landed < 0) {
            double h = h_next, slope = 0.0;
            if (mode == UPRIGHT && g->kind != 0.0)
                h = fmin(h, 1.0 / fabs(g->c1)); /* eight samples of a guard follow the sine */
            int cut = t + 1.1 * h >= last, target = -1, corrections = 0, crested = 0;
            if (cut)
                h = last - t;
            for (;;) {
                ++taken;
                double error = take_step(mode, t, h, y, c, g, rtol, atol, k, y_new);
                if (target < 0 && !(error <= 1.0)) {
                    cut = 0;
                    h *= fmax(0.1, isfinite(error) ? 0.9 * pow(error, -0.125) : 0.1);
                    h_next = h;
                    if (h <= 4.0 * EPS * t || h < 1e-290 || taken >= o->max_steps) {
                        outcome = isfinite(error) ? STALLED : NOT_FINITE;
                        break;
                    }
                    continue;
                }
                if (target >= 0) {
                    double left;
                    if (mode == UPRIGHT)
                        left = -opening(target ? 1.0 : -1.0, y_new, c, ground_at(g, t + h));
                    else
                        left = (mode - 1.0) * y_new[ROTATION];
                    double move = slope < 0.0 ? -left / slope : 0.0;
                    double least = fmax(2.0 * EPS * (t + h), 1e-5 * rtol * h);
                    if (corrections < 3 && least < fabs(move) && fabs(move) < 0.01 * h) {
                        ++corrections;
                        h += move;
                        continue;
                    }
                    landed = target;
                } else if (!cut) {
                    /* proportional-integral control; errors by their logarithms */
                    error = log(fmax(error, 1e-10));
                    double factor = 0.9 * exp(-0.125 * (0.7 * error - 0.4 * last_error));
                    last_error = error;
                    h_next = h * fmin(5.0, fmax(0.2, factor));
                }
                int open = landed < 0 &&
                           (mode != UPRIGHT
                                ? stays_open(mode - 1.0, h, y, y_new, k, closed == 0)
                                : closed < 0 && stays_held(t, h, y, y_new, k, c, g));
                crested = with_peak && may_crest(h, y, y_new, k, peak);
                if ((!open && landed < 0) || crested || fabs(y_new[ROTATION]) >= o->fallen)
                    dense_output(mode, t, h, y, c, g, k, poly);
                if (landed >= 0 || open)
                    break;
                double place = NEVER;
                int guards = guard_polynomials(mode, t, h, c, g, poly, b);
                for (int i = 0; i < guards; ++i) {
                    double noise =
                        closed == i ? rounding(mode, h, y, c, g, t, b[i]) : 0.0;
                    double x = first_fall(b[i], closed == i, noise);
                    if (x < place) {
                        place = x;
                        target = i;
                        bernstein_at(b[i], x, &slope);
                        slope /= h;
                    }
                }
                if (target < 0)
                    break;
                if (place * h <= 4.0 * EPS * fmax(t, h)) {
                    if (closed == target && y[RATE] == 0.0 && h > 1e-6 * h_next) {
                        /* an uplift so short that rounding hides it in a step of this length */
                        h *= 0.1;
                        cut = 0;
                        target = -1;
                        continue;
                    }
                    h = 0.0;
                }
                if (place >= 1.0 || h == 0.0) {
                    landed = target;
                    break;
                }
                h *= place;
                cut = 0;
            }
            if (outcome != COMPLETED)
                break;

            if (h > 0.0 && fabs(y_new[ROTATION]) >= o->fallen) {
                double low = 0.0, high = 1.0;
                for (int n = 0; n < 60; ++n) {
                    double x = 0.5 * (low + high);
                    if (fabs(dense_at(poly, x, ROTATION)) < o->fallen)
                        low = x;
                    else
                        high = x;
                }
                for (int i = 0; i < N; ++i)
                    y_new[i] = dense_at(poly, high, i);
                h *= high;
                cut = 0;
                outcome = OVERTURNED;
            }
            if (h > 0.0) {
                if (with_peak) {
                    peak = fmax(peak, fabs(y_new[ROTATION]));
                    if (outcome == COMPLETED && crested)
                        peak = fmax(peak, crest(poly));
                }
                t = cut || t + h > last ? last : t + h;
                memcpy(y, y_new, sizeof y);
                memcpy(k[0], k[STAGES], sizeof y);
                closed = -1;
                idle = 0;
                ++accepted;
            }
            if (outcome != COMPLETED)
                break;
            if (taken >= o->max_steps) {
                outcome = STALLED;
                break;
            }
        }
        if (landed < 0)
            continue;

        if (++idle > 100) {
            outcome = CHATTER;
            break;
        }
        int before = mode;
        fresh = 1;
        if (before == UPRIGHT) {
            mode = landed ? 2 : 0;
            record(&events[n_events++], t, UPLIFT, before, mode, y, y);
            closed = 0;
            h_next = 0.0; /* the gap opens slowly: its first moments want a short step */
            continue;
        }
        mode = rebound(before, y, o->ratio, after);
        record(&events[n_events++], t, IMPACT, before, mode, y, after);
        memcpy(y, after, sizeof y);
        closed = mode == UPRIGHT ? -1 : 0;
        if (idle > 1 && mode == UPRIGHT) /* opened and closed in no time: that uplift was none */
            closed = before == 2;
        if (++impacts > o->max_impacts) {
            outcome = TOO_MANY_IMPACTS;
            break;
        }
        if (mode == UPRIGHT)
            continue;
        int follows;
        double rests = time_to_rest(mode, y, c, o->ratio, g, t, o->rest_tolerance, after,
                                    &follows);
        if (t + rests < last || rests < 16.0 * EPS * t) {
            t += rests;
            record(&events[n_events++], t, REST, mode, follows, y, after);
            memcpy(y, after, sizeof y);
            mode = follows;
            closed = -1;
            h_next = 0.0;
        }
    }
    st->t = t;
    st->h_next = h_next;
    st->peak = peak;
    memcpy(st->y, y, sizeof y);
    st->mode = mode;
    st->closed = closed;
    st->impacts = impacts;
    st->taken = taken;
    st->accepted = accepted;
    st->n_events = n_events;
    return outcome;
}

/* -- what is called from outside --------------------------------------------------------------- */

/* One motion; the events go into the caller's array. */
int run(state *st, double t_end, const law *motion, long n_laws, const double *parameters,
        const options *o, event *events, long max_events)
{
    constants c = prepare(parameters);
    return integrate(st, t_end, motion, n_laws, &c, o, events, max_events, 0);
}

/* Many motions of n_laws rows each, from rest: outcome and largest |rotation| of each. What is
 * still rocking at the end is followed until the next impact, to tell a fall from a return. */
void map(long n, double t_end, const law *motions, long n_laws, const double *parameters,
         const options *o, long *outcomes, double *peaks)
{
    constants c = prepare(parameters);
    options until_impact = *o;
    until_impact.max_impacts = 0;
    event events[64];
    for (long m = 0; m < n; ++m) {
        state st = {.mode = UPRIGHT, .closed = -1};
        const law *motion = motions + m * n_laws;
        int outcome;
        do {
            st.n_events = 0;
            outcome = integrate(&st, t_end, motion, n_laws, &c, o, events, 64, 1);
        } while (outcome == FULL);
        peaks[m] = st.peak;
        if (outcome == COMPLETED && st.mode != UPRIGHT) {
            st.t = st.h_next = 0.0;
            st.closed = -1;
            st.impacts = st.n_events = 0;
            if (integrate(&st, 1e3 * t_end, NULL, 0, &c, &until_impact, events, 64, 0) ==
                OVERTURNED)
                outcome = OVERTURNED;
        }
        outcomes[m] = outcome;
    }
}

/* Many starts under the same motion: times of the first n_times impacts of each. Peaks are followed
 * as in a map. */
void many(long n, const double *starts, long mode, double t_end, const law *motion, long n_laws,
          const double *parameters, const options *o, double *times, long n_times)
{
    constants c = prepare(parameters);
    event events[64];
    for (long m = 0; m < n; ++m) {
        state st = {.mode = mode, .closed = -1};
        memcpy(st.y, starts + m * N, sizeof st.y);
        long found = 0;
        int outcome;
        do {
            st.n_events = 0;
            outcome = integrate(&st, t_end, motion, n_laws, &c, o, events, 64, 1);
            for (long e = 0; e < st.n_events && found < n_times; ++e)
                if (events[e].kind == IMPACT)
                    times[m * n_times + found++] = events[e].time;
        } while (outcome == FULL);
    }
}
