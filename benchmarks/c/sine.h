/* Sine and cosine of one angle: the C library's, or (INLINE_SINE) a polynomial in the loop itself,
 * or (SMALL_ANGLES) one that expects angles below pi/4, and takes others, too.
 *
 * The polynomial is the Taylor series on [-pi/4, pi/4], cut where it falls below half a unit in the
 * last place, and that for small angles fdlibm's of least error, summed in pairs; the angle is
 * reduced by multiples of pi/2 in two parts, for angles below 1e5.
 */

#include <math.h>

/* The Taylor series of the sine of r; s : the factor of r^15, with what follows it. */
static inline double sine_series(double r, double s)
{
    double z = r * r;
    s = s * z + 1.0 / 6227020800.0;
    s = s * z - 1.0 / 39916800.0;
    s = s * z + 1.0 / 362880.0;
    s = s * z - 1.0 / 5040.0;
    s = s * z + 1.0 / 120.0;
    s = s * z - 1.0 / 6.0;
    return r + r * z * s;
}

static inline void sine_cosine(double x, double *sine, double *cosine)
{
#ifdef SMALL_ANGLES
    double r = x;
    long quadrant = 0;
    if (__builtin_expect(fabs(x) > 0.78539816339744830962, 0)) {
        double n = rint(x * 0.63661977236758134308);
        r = (x - n * 0x1.921fb54400000p+0) - n * 0x1.0b4611a626331p-34;
        quadrant = (long)n;
    }
    double z = r * r, zz = z * z, r3 = r * z;
    double s0 = -1.66666666666666324348e-01 + z * 8.33333333332248946124e-03;
    double s1 = -1.98412698298579493134e-04 + z * 2.75573137070700676789e-06;
    double s2 = -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10;
    double c0 = 4.16666666666666019037e-02 - z * 1.38888888888741095749e-03;
    double c1 = 2.48015872894767294178e-05 - z * 2.75573143513906633035e-07;
    double c2 = 2.08757232129817482790e-09 - z * 1.13596475577881948265e-11;
    double s = r + r3 * (s0 + zz * (s1 + zz * s2));
    double c = (1.0 - 0.5 * z) + zz * (c0 + zz * (c1 + zz * c2));
    if (__builtin_expect(quadrant & 3, 0)) {
        double a = quadrant & 1 ? c : s, b = quadrant & 1 ? s : c;
        s = quadrant & 2 ? -a : a;
        c = (quadrant + 1) & 2 ? -b : b;
    }
    *sine = s;
    *cosine = c;
#elif defined(INLINE_SINE)
    double n = rint(x * 0.63661977236758134308);
    double r = (x - n * 0x1.921fb54400000p+0) - n * 0x1.0b4611a626331p-34;
    double z = r * r;
    double s = sine_series(r, -1.0 / 1307674368000.0);
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
#if defined(INLINE_SINE) || defined(SMALL_ANGLES)
    double sine, cosine;
    sine_cosine(x, &sine, &cosine);
    return sine;
#else
    return sin(x);
#endif
}
