/* The integration loop as one would write it for these structures alone: not rockeom's method.
 *
 * Its equations are those of loop.h, out of the same files. It differs in how it steps, and in how
 * it meets events:
 *
 * - The structure rocks about the side +1, always: at an impact state and ground change their sign.
 * - Coordinates move by the accelerations of the stages alone (the method in Nystrom's form, with
 *   A^2 in place of A), so that a stage's sine need not wait for the stage just before it; and
 *   rates that no acceleration asks for are not computed.
 * - Inside a step only the quintic through both ends is known. In Bernstein form it certifies that
 *   no gap closes, or has the one root to which the step is redone; what then is left to the event
 *   it extrapolates. A hop within a step is tried at once with the length of its parabola. There is
 *   no dense output: a crest, too, is the end of a step on the side.
 * - A block with both feet down does not step: what lifts it is solved for.
 * - Endless impacts are completed by the sum of their series in one expression.
 *
 * With both feet down a structure of two coordinates wants ground of straight lines.
 */

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "ground.h"
#include "method.h"

#define M (N / 2) /* coordinates; their rates stand behind them in the state */

/* fmax and fmin ask for NaN, and are called. */
static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

enum { COMPLETED, CAME_TO_REST, OVERTURNED, TOO_MANY_IMPACTS, STALLED };

/* -- ground ----------------------------------------------------------------------------------- */

static inline double ground_slope(const law *g, double t)
{
    return g->kind == 0.0 ? g->c1 : g->c0 * g->c1 * cos(g->c1 * (t - g->start) + g->c2);
}

/* At all stages of a step, for the mirrored structure; several sines at once. */
static inline void ground_at_stages(const law *g, double side, double t, double h, double *out)
{
    double tau = t - g->start;
    if (g->kind == 0.0) {
        double a = side * (g->c0 + g->c1 * tau), slope = side * g->c1 * h;
        for (int j = 0; j <= STAGES; ++j)
            out[j] = a + C[j] * slope;
        return;
    }
    double amplitude = side * g->c0, angle = g->c1 * tau + g->c2, turn = g->c1 * h;
#pragma omp simd
    for (int j = 0; j <= STAGES; ++j) {
        double x = angle + C[j] * turn;
        double n = rint(x * 0.31830988618379067154); /* multiples of pi: odd ones change the sign */
        double r = (x - n * 0x1.921fb54400000p+1) - n * 0x1.0b4611a626331p-33;
        double odd = n - 2.0 * rint(0.5 * n), z = r * r;
        double s = 1.0 / 51090942171709440000.0;
        s = s * z - 1.0 / 121645100408832000.0;
        s = s * z + 1.0 / 355687428096000.0;
        s = sine_series(r, s * z - 1.0 / 1307674368000.0);
        out[j] = amplitude * (s - 2.0 * odd * odd * s);
    }
}

/* -- one step --------------------------------------------------------------------------------- */

static inline void accelerations(int rocking, const double *y, const constants *c, double a,
                                 double *out)
{
    double dy[N];
    if (rocking)
        rates(1.0, y, c, a, dy);
    else
        rates_upright(y, c, a, dy);
    for (int i = 0; i < M; ++i)
        out[i] = dy[M + i];
}

#define STAGE(j)                                                                                   \
    for (int i = 0; i < M; ++i) {                                                                  \
        w[i] = y[i] + MOVE_##j(i);                                                                 \
        w[M + i] = y[M + i] + h * (SUM_##j(i));                                                    \
    }                                                                                              \
    accelerations(rocking, w, c, ground[j], a[j]);

/* a0 and a1 are the accelerations at both ends. Returns the error, 1 at the tolerance; only where
 * it is asked for. */
static inline __attribute__((always_inline)) double
take_step(int rocking, int with_error, double h, const double *restrict y,
          const double *restrict a0, const constants *restrict c, const double *restrict ground,
          double rtol, double atol, double *restrict y1, double *restrict a1)
{
    double a[STAGES + 1][M], w[N];
    for (int i = 0; i < M; ++i)
        a[0][i] = a0[i];
    EACH_STAGE
    for (int i = 0; i < M; ++i) {
        y1[i] = w[i];
        y1[M + i] = w[M + i];
        a1[i] = a[STAGES][i];
    }
    if (!with_error)
        return 0.0;
    double s0 = 0.0, s1 = 0.0;
    for (int i = 0; i < M; ++i) {
        double place = 1.0 / (atol + rtol * larger(fabs(y[i]), fabs(y1[i])));
        double speed = 1.0 / (atol + rtol * larger(fabs(y[M + i]), fabs(y1[M + i])));
        double e = place * h * (ERROR_MOVE_0(i)), f = speed * (ERROR_0(i));
        s0 += e * e + f * f;
        e = place * h * (ERROR_MOVE_1(i)), f = speed * (ERROR_1(i));
        s1 += e * e + f * f;
    }
    if (s0 == 0.0)
        return 0.0;
    return TWO_ERRORS ? h * s0 / sqrt((s0 + 0.01 * s1) * N) : h * sqrt(s0 / N);
}

/* The same with what the ground does meanwhile; two functions, so that neither asks which it is. */
static __attribute__((noinline)) double rocking_step(int with_error, const law *g, double side,
                                                     double t, double h, const double *y,
                                                     const double *a0, const constants *c,
                                                     double rtol, double atol, double *y1,
                                                     double *a1)
{
    double ground[STAGES + 1];
    ground_at_stages(g, side, t, h, ground);
    return take_step(1, with_error, h, y, a0, c, ground, rtol, atol, y1, a1);
}

static __attribute__((noinline)) double standing_step(int with_error, const law *g, double t,
                                                      double h, const double *y, const double *a0,
                                                      const constants *c, double rtol,
                                                      double atol, double *y1, double *a1)
{
    double ground[STAGES + 1];
    ground_at_stages(g, 1.0, t, h, ground);
    return take_step(0, with_error, h, y, a0, c, ground, rtol, atol, y1, a1);
}

static inline double step(int rocking, int with_error, const law *g, double side, double t,
                          double h, const double *y, const double *a0, const constants *c,
                          double rtol, double atol, double *y1, double *a1)
{
    if (rocking)
        return rocking_step(with_error, g, side, t, h, y, a0, c, rtol, atol, y1, a1);
    return standing_step(with_error, g, t, h, y, a0, c, rtol, atol, y1, a1);
}

/* x^p within some per cent: the number of an IEEE double is nearly its logarithm. */
static inline double roughly_power(double x, double p)
{
    const int64_t one = 0x3ff0000000000000;
    int64_t bits;
    memcpy(&bits, &x, sizeof x);
    bits = one + (int64_t)(p * (double)(bits - one));
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* -- what is known inside a step -------------------------------------------------------------- */

/* Bernstein coefficients of the quintic through value, rate and acceleration at both ends. */
static inline void quintic(double h, double q0, double v0, double a0, double q1, double v1,
                           double a1, double *b)
{
    double f = 0.2 * h, s = 0.05 * h * h;
    b[0] = q0;
    b[1] = q0 + f * v0;
    b[2] = q0 + 2.0 * f * v0 + s * a0;
    b[3] = q1 - 2.0 * f * v1 + s * a1;
    b[4] = q1 - f * v1;
    b[5] = q1;
}

static inline double bernstein_at(const double *b, double x, double *slope)
{
    double w[6];
    memcpy(w, b, sizeof w);
#pragma GCC unroll 8
    for (int n = 5; n > 1; --n)
#pragma GCC unroll 8
        for (int i = 0; i < n; ++i)
            w[i] += x * (w[i + 1] - w[i]);
    *slope = 5.0 * (w[1] - w[0]);
    return w[0] + x * (w[1] - w[0]);
}

/* Coefficients from `first` on, which are those of the polynomial over x^first but for positive
 * factors: how often they change their sign, at least as often as the polynomial, from above. */
static inline int falls(const double *b, int first)
{
    int changes = 0, above = 1;
    for (int i = first; i < 6; ++i)
        if ((b[i] > 0.0) != above) {
            above = !above;
            ++changes;
        }
    return changes;
}

/* The one fall through zero, by Newton's method within a bracket. */
static double root(const double *b)
{
    double low = 0.0, high = 1.0;
    double rise = 5.0 * (b[1] - b[0]), bend = b[0] + rise - b[5];
    double x = (rise + sqrt(larger(rise * rise + 4.0 * bend * b[0], 0.0))) / (2.0 * bend);
    if (!(0.0 < x && x < 1.0))
        x = 0.5;
    for (int n = 0; n < 60; ++n) {
        double slope, value = bernstein_at(b, x, &slope);
        if (value > 0.0)
            low = x;
        else
            high = x;
        double next = slope < 0.0 ? x - value / slope : 0.0;
        if (!(low < next && next < high))
            next = 0.5 * (low + high);
        double step = fabs(next - x);
        x = next;
        if (step < 1e-7) /* the error left is about the square of that */
            break;
    }
    return x;
}

/* The side that may lift within a step with both feet down, and what holds it less what pulls;
 * 0 where none lifts. The pull is a sum of the state and the ground, all polynomials here. */
static inline double full_contact(double h, double t, const law *g, const double *y,
                                  const double *a0, const double *y1, const double *a1,
                                  const constants *c, double *b)
{
    double w[6][N], least = 0.0, most = 0.0, limit = hold(c);
    for (int i = 0; i < M; ++i) {
        quintic(h, y[i], y[M + i], a0[i], y1[i], y1[M + i], a1[i], b);
        for (int j = 0; j < 6; ++j) {
            double before = j > 0 ? b[j] - b[j - 1] : 0.0, after = j < 5 ? b[j + 1] - b[j] : 0.0;
            w[j][i] = b[j];
            w[j][M + i] = (j * before + (5 - j) * after) / h;
        }
    }
    double a = ground_at(g, t), step = 0.2 * (ground_at(g, t + h) - a);
    for (int j = 0; j < 6; ++j) {
        b[j] = pull(w[j], c, a + j * step);
        least = smaller(least, b[j]);
        most = larger(most, b[j]);
    }
    if (most < limit && -least < limit)
        return 0.0;
    double side = most > -least ? 1.0 : -1.0;
    for (int j = 0; j < 6; ++j)
        b[j] = limit - side * b[j];
    return side;
}

/* Move the end of a step by e, a small part of it, on the quintic through both ends. */
static inline void extrapolate(double h, double e, const double *y, const double *a0, double *y1,
                               const double *a1)
{
    for (int i = 0; i < M; ++i) {
        double jerk = (60.0 * (y1[i] - y[i]) / h - 36.0 * y1[M + i] - 24.0 * y[M + i]) / (h * h) +
                      (9.0 * a1[i] - 3.0 * a0[i]) / h;
        y1[i] += e * (y1[M + i] + e * (0.5 * a1[i] + e * jerk / 6.0));
        y1[M + i] += e * (a1[i] + 0.5 * e * jerk);
    }
}

/* -- the loop ---------------------------------------------------------------------------------- */

typedef struct {
    double rtol, atol, fallen, rest_tolerance, ratio;
    long max_impacts, steps_per_segment; /* of the latter 0: by the error */
} options;

typedef struct {
    double time, rate;
} impact;

typedef struct {
    double t, peak, side, y[N]; /* side 0: both feet down; the state is not mirrored */
    long impacts, steps, landings, crests, refused;
} motion;

/* Time from the end of a step to the event, by what is left there of the gap, or of what holds. */
static inline double remains(double side, double lifts, double t, const law *g, const double *y,
                             const double *a, const constants *c)
{
    if (side != 0.0) {
        double e = -y[0] / y[M];
        return e - 0.5 * a[0] * e * e / y[M];
    }
    double slopes[N];
    for (int i = 0; i < M; ++i) {
        slopes[i] = y[M + i];
        slopes[M + i] = a[i];
    }
    return (hold(c) - lifts * pull(y, c, ground_at(g, t))) /
           (lifts * pull(slopes, c, ground_slope(g, t)));
}

/* Where the slope of a quintic is zero, near x. */
static inline double top(const double *b, double x)
{
    for (int n = 0; n < 3; ++n) {
        double w[5];
        for (int i = 0; i < 5; ++i)
            w[i] = b[i + 1] - b[i];
#pragma GCC unroll 4
        for (int m = 4; m > 1; --m)
#pragma GCC unroll 4
            for (int i = 0; i < m; ++i)
                w[i] += x * (w[i + 1] - w[i]);
        double bend = 4.0 * (w[1] - w[0]);
        x -= (w[0] + x * (w[1] - w[0])) / bend;
        x = smaller(1.0, larger(0.0, x));
    }
    return x;
}

/* First time from t on at which the ground lifts a block that stands, or the end of the law. */
static double lift_off(const law *g, double t, double end, double limit)
{
    double a = ground_at(g, t);
    if (fabs(a) > limit)
        return t;
    if (g->kind == 0.0) {
        double at_end = a + g->c1 * (end - t);
        return fabs(at_end) > limit ? t + (copysign(limit, g->c1) - a) / g->c1 : end;
    }
    if (fabs(g->c0) <= limit)
        return end;
    double angle = g->c1 * (t - g->start) + g->c2;
    double wait = fmod(asin(limit / fabs(g->c0)) - angle, M_PI);
    return smaller(end, t + (wait < 0.0 ? wait + M_PI : wait) / g->c1);
}

/* Time that the endless impacts to come will take, the first flight beginning here; or infinity.
 * Both gaps close with their accelerations, in parabolas whose speeds are a geometric series. */
static double time_to_rest(const double *y, const double *a0, const constants *c, double ground,
                           double ratio, double tolerance, double *kick)
{
    double v = y[M], closing = -a0[0];
    if (!(closing > 0.0) || 4.0 * v * v > tolerance * tolerance * closing || !(ratio < 1.0))
        return INFINITY;
    double w[N], held[M], other[N];
    for (int i = 0; i < N; ++i)
        other[i] = -y[i];
    other[0] = other[M] = 0.0;
    double opposite = -opening(1.0, other, c, -ground);
    if (!(opposite > 0.0))
        return INFINITY;
    double rest = 2.0 * v / (1.0 - ratio * ratio) * (1.0 / closing + ratio / opposite);
    if (rest * rest * closing > tolerance * tolerance)
        return INFINITY;
    memcpy(w, y, sizeof w);
    accelerations(0, w, c, ground, held);
    for (int i = 1; i < M; ++i) /* what turns to and fro has pulled in flight, and no impact did */
        kick[i] = (a0[i] - held[i]) / a0[0] * (-2.0 * v / (1.0 + ratio));
    return rest;
}

static int integrate(motion *st, double end, const law *laws, long n_laws, const constants *c,
                     const options *o, impact *impacts, long room)
{
    double y[N], y1[N], a0[M], a1[M], b[6];
    double t = st->t, side = st->side, peak = st->peak, h_next = 0.0, last_error = 1.0;
    const double rtol = o->rtol, atol = o->atol, held = hold(c);
    long i_law = 0;
    int fresh = 1, closed = 0, outcome = COMPLETED;
    const law *g = law_at(laws, n_laws, &i_law, t);
    for (int i = 0; i < N; ++i)
        y[i] = side < 0.0 ? -st->y[i] : st->y[i];
    /* the first step of a motion: a part of its own time */
    const double start = 0.1 / sqrt(fabs(opening(1.0, st->y, c, 0.0)));

    while (t < end) {
        if (t >= g->end) {
            double before = ground_at(g, t), after;
            g = law_at(laws, n_laws, &i_law, t);
            after = ground_at(g, t);
            if (fabs(after - before) > 1e-10 * (fabs(before) + fabs(after)))
                fresh = 1; /* the ground jumps: so do the accelerations */
        }
        double last = smaller(g->end, end);
        if (side == 0.0 && M == 1) {
            t = lift_off(g, t, last, fabs(held / pull(y, c, 1.0)));
            if (t >= last) {
                t = last;
                continue;
            }
        }
        if (side == 0.0 && (M == 1 || fresh)) {
            double pulled = pull(y, c, ground_at(g, t));
            if (M == 1 || fabs(pulled) > held) { /* it does not stand */
                side = pulled > 0.0 ? 1.0 : -1.0;
                for (int i = 0; i < N; ++i)
                    y[i] *= side;
                fresh = closed = 1;
                h_next = 0.0;
            }
        }
        const int rocking = side != 0.0;
        const double facing = side < 0.0 ? -1.0 : 1.0;
        if (fresh) {
            accelerations(rocking, y, c, facing * ground_at(g, t), a0);
            fresh = 0;
        }
        if (h_next == 0.0)
            h_next = start;
        const int equal = o->steps_per_segment > 0 && g->end < INFINITY;
        double h = equal ? (g->end - g->start) / o->steps_per_segment : h_next;
        int cut = t + 1.1 * h >= last, lands = 0;
        if (cut)
            h = last - t;
        /* a hop so short that its parabola tells where it ends */
        const double flight = rocking && closed && a0[0] < 0.0 ? -2.0 * y[M] / a0[0] : 0.0;
        int hops = flight > 0.0 && flight < 0.9 * h;
        if (hops) {
            h = flight;
            cut = 0;
        }

        /* -- a step; what its quintic leaves in doubt is looked at in halves */
        double lifts = 0.0;
        for (;;) {
            if (h < 1e-14) {
                outcome = STALLED;
                break;
            }
            ++st->steps;
            double error = step(rocking, !equal, g, facing, t, h, y, a0, c, rtol, atol, y1, a1);
            if (!equal && !(error <= 1.0)) {
                ++st->refused;
                h *= larger(0.1, 0.9 * roughly_power(smaller(error, 1e10), -1.0 / ERROR_ORDER));
                h_next = h;
                hops = cut = 0;
                continue;
            }
            if (!equal && !cut && !hops) {
                /* proportional-integral control */
                error = larger(error, 1e-10);
                double factor = roughly_power(error, -0.7 / ERROR_ORDER) *
                                roughly_power(last_error, 0.4 / ERROR_ORDER);
                last_error = error;
                h_next = h * smaller(5.0, larger(0.2, 0.9 * factor));
            }
            int changes;
            if (rocking) {
                quintic(h, y[0], y[M], a0[0], y1[0], y1[M], a1[0], b);
                changes = falls(b, closed ? (y[M] > 0.0 ? 1 : 3) : 0);
                hops = hops && fabs(y1[0]) < -0.1 * h * y1[M] && changes == (b[5] <= 0.0);
            } else {
                lifts = full_contact(h, t, g, y, a0, y1, a1, c, b);
                changes = lifts == 0.0 ? 0 : falls(b, 0);
            }
            lands = hops || (changes == 1 && b[5] <= 0.0);
            if (changes == 0 || lands)
                break;
            h *= 0.5;
            h_next = h;
            cut = 0;
        }
        if (outcome != COMPLETED)
            break;
        if (rocking && y[M] > 0.0 && y1[M] < 0.0 &&
            larger(larger(b[1], b[2]), larger(b[3], b[4])) > peak) {
            /* a crest that may be the largest: the end of a step on the side */
            double crest[N], bend[M], x = top(b, y[M] / (y[M] - y1[M]));
            ++st->crests;
            step(1, 0, g, facing, t, x * h, y, a0, c, rtol, atol, crest, bend);
            peak = larger(peak, crest[0] - 0.5 * crest[M] * crest[M] / bend[0]);
        }
        if (lands) {
            /* once more, to the event; what is then left is extrapolated, with an error about its
             * square, in units of the step */
            const double small = larger(1e-13, smaller(1e-6, rtol));
            double e = hops ? 0.0 : h * (root(b) - 1.0);
            for (int n = hops; n < 5; ++n) {
                if (n > 0) {
                    e = remains(side, lifts, t + h, g, y1, a1, c);
                    if (e * e <= small * h * h)
                        break;
                }
                h += e;
                ++st->landings;
                step(rocking, 0, g, facing, t, h, y, a0, c, rtol, atol, y1, a1);
            }
            extrapolate(h, e, y, a0, y1, a1);
            h += e;
            cut = 0;
        } else if (rocking && y1[0] > o->fallen) {
            outcome = OVERTURNED;
        }
        t = cut ? last : t + h;
        memcpy(y, y1, sizeof y);
        memcpy(a0, a1, sizeof a0);
        closed = 0;
        if (outcome != COMPLETED)
            break;
        if (!lands)
            continue;
        if (!rocking) {
            side = lifts;
            for (int i = 0; i < N; ++i)
                y[i] *= side;
            y[0] = y[M] = 0.0;
            fresh = closed = 1;
            h_next = 0.0;
            continue;
        }

        /* -- the impact */
        double after[N], kick[M] = {0.0};
        if (st->impacts < room)
            impacts[st->impacts] = (impact){t, side * y[M]};
        ++st->impacts;
        rebound(2, y, o->ratio, after);
        for (int i = 0; i < N; ++i)
            y[i] = -after[i];
        y[0] = 0.0;
        side = -side;
        closed = 1;
        if (st->impacts > o->max_impacts) {
            outcome = TOO_MANY_IMPACTS;
            break;
        }
        double a = side * ground_at(g, t);
        accelerations(1, y, c, a, a0);
        double rest = time_to_rest(y, a0, c, a, o->ratio, o->rest_tolerance, kick);
        if (t + rest < last) {
            for (int i = 1; i < M; ++i)
                y[M + i] += kick[i];
            for (int i = 0; i < N; ++i)
                y[i] *= side;
            y[0] = y[M] = 0.0;
            if (M > 1) { /* what still moves moves through the time in which the impacts fade */
                accelerations(0, y, c, ground_at(g, t), a0);
                step(0, 0, g, 1.0, t, rest, y, a0, c, rtol, atol, y1, a1);
                memcpy(y, y1, sizeof y);
            }
            t += rest;
            side = 0.0;
            fresh = 1;
            closed = 0;
            h_next = 0.0;
        }
    }
    st->t = t;
    st->side = side;
    st->peak = peak;
    for (int i = 0; i < N; ++i)
        st->y[i] = side < 0.0 ? -y[i] : y[i];
    return outcome;
}

/* -- what is called from outside --------------------------------------------------------------- */

/* Accelerations of the equations, for comparison with those that rockeom derives. */
void accelerate(int mode, const double *y, const double *parameters, double ground, double *out)
{
    constants c = prepare(parameters);
    double side = mode - 1.0, w[N];
    for (int i = 0; i < N; ++i)
        w[i] = side < 0.0 ? -y[i] : y[i];
    accelerations(side != 0.0, w, &c, side < 0.0 ? -ground : ground, out);
    for (int i = 0; i < M; ++i)
        out[i] = side < 0.0 ? -out[i] : out[i];
}

/* Acceleration with which a side would open from rest, for the same comparison. */
double opens(double side, const double *y, const double *parameters, double ground)
{
    constants c = prepare(parameters);
    return opening(side, y, &c, ground);
}

/* One motion; its impacts, as many as there is room for, go into the caller's array. */
int run(motion *st, double end, const law *laws, long n_laws, const double *parameters,
        const options *o, impact *impacts, long room)
{
    constants c = prepare(parameters);
    return integrate(st, end, laws, n_laws, &c, o, impacts, room);
}

/* Many motions of n_laws rows each, from rest: outcome and largest |rotation| of each. What is
 * still rocking at the end is followed until it falls or comes back. */
void map(long n, double end, const law *laws, long n_laws, const double *parameters,
         const options *o, long *outcomes, double *peaks)
{
    constants c = prepare(parameters);
    options until_impact = *o;
    until_impact.max_impacts = 0;
    for (long m = 0; m < n; ++m) {
        motion st = {0};
        int outcome = integrate(&st, end, laws + m * n_laws, n_laws, &c, o, NULL, 0);
        peaks[m] = st.peak;
        if (outcome == COMPLETED && st.side * st.y[M] > 0.0) {
            st.t = 0.0;
            st.impacts = 0;
            if (integrate(&st, 1e3 * end, NULL, 0, &c, &until_impact, NULL, 0) == OVERTURNED)
                outcome = OVERTURNED;
        }
        outcomes[m] = outcome;
    }
}

/* Many starts under the same motion: times of the first impacts of each. */
void many(long n, const double *starts, double side, double end, const law *laws, long n_laws,
          const double *parameters, const options *o, impact *impacts, long room)
{
    constants c = prepare(parameters);
    for (long m = 0; m < n; ++m) {
        motion st = {.side = side, .peak = fabs(starts[m * N])};
        memcpy(st.y, starts + m * N, sizeof st.y);
        integrate(&st, end, laws, n_laws, &c, o, impacts + m * room, room);
    }
}
