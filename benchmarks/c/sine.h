/* Sine and cosine of one angle: the C library's, or (INLINE_SINE) a polynomial in the loop itself.
 *
 * The polynomial is the Taylor series on [-pi/4, pi/4], cut where it falls below half a unit in the
 * last place; the angle is reduced by multiples of pi/2 in two parts, for angles below 1e5.
 */

#include <math.h>

static inline void sine_cosine(double x, double *sine, double *cosine)
{
#ifdef INLINE_SINE
    double n = rint(x * 0.63661977236758134308);
    double r = (x - n * 0x1.921fb54400000p+0) - n * 0x1.0b4611a626331p-34;
    double z = r * r;
    double s = -1.0 / 1307674368000.0;
    s = s * z + 1.0 / 6227020800.0;
    s = s * z - 1.0 / 39916800.0;
    s = s * z + 1.0 / 362880.0;
    s = s * z - 1.0 / 5040.0;
    s = s * z + 1.0 / 120.0;
    s = s * z - 1.0 / 6.0;
    s = r + r * z * s;
    double c = 1.0 / 20922789888000.0;
    c = c * z - 1.0 / 87178291200.0;
    c = c * z + 1.0 / 479001600.0;
    c = c * z - 1.0 / 3628800.0;
    c = c * z + 1.0 / 40320.0;
    c = c * z - 1.0 / 720.0;
    c = c * z + 1.0 / 24.0;
    c = 1.0 - (0.5 * z - z * z * c);
    long quadrant = (long)n;
    double a = quadrant & 1 ? c : s, b = quadrant & 1 ? s : c;
    *sine = quadrant & 2 ? -a : a;
    *cosine = (quadrant + 1) & 2 ? -b : b;
#else
    *sine = sin(x);
    *cosine = cos(x);
#endif
}

/* Of the ground's acceleration. */
static inline double sine_of(double x)
{
#ifdef INLINE_SINE
    double sine, cosine;
    sine_cosine(x, &sine, &cosine);
    return sine;
#else
    return sin(x);
#endif
}
