"""The tolerances of the integrator, each by what it bounds, with the error that it allows for.

They are of five kinds: the unit of rounding and its multiples, margins that no error can feign,
sizes that count as none beside another, moves after which an iteration has ended, and small steps
by which something is looked at. All are relative, but for the smallest numbers.

A velocity of a rocking motion is compared with sqrt(a l), and a time with sqrt(l/a): a is the
acceleration of a point in free motion, and l a radius of gyration.
"""

# -- rounding ------------------------------------------------------------------------------------

# The unit of rounding: twice the largest relative error of one operation.
EPS = 2.220446049250313e-16
# Relative to the Bernstein coefficients of a coordinate: sums of eight terms of its dense output,
# see `polynomial_of`. They count as zero below it, relative to the largest.
EXACT = 8.0 * EPS
# The same of a guard that is sampled: sums of eight samples, each off by half a unit, with weights
# of 86 in all at most: 43 units.
SAMPLED = 64.0 * EPS
# Relative to a gap, relative to the terms whose difference it is: 18 units of rounding.
GRAIN = 4e-15
# Relative to a sum of terms of the size of a velocity or of a place: what is left below it is
# rounding, and becomes zero, so that a point which is put on the ground does not leave it at once.
NONE_OF_SUM = 1e-14
# Relative to the time: closer events are at one instant. A time is a sum of steps, whose rounding
# errors add up.
SAME_INSTANT = 1e3 * EPS
# Relative to a gap at the end of a step: a coefficient below it says that the gap opens from rest.
# It is zero but for rounding errors of the accelerations of both sides, which cancel.
GAP_AT_REST = 1e-11
# Relative to the accelerations that open a gap on either side: where they cancel, as beside uplift,
# so much is left of them by rounding, and moves a gap that opens from rest.
ACCELERATION_AT_REST = 1e-10
# Relative to a force in a step, at most: by so much a guard of a force may seem to be open or below
# zero where it was zero, as twice what its polynomial has at the start.
FORCE_AT_REST = 1e-8
# Relative to the overturning rotation: by so much feet may miss the ground on landing, since a step
# that is repeated ends within some units of rounding of the gap's root.
GAP_ON_LANDING = 1e-12
# Relative to accelerations: rounding errors of those of a point, and of the least that opens a gap
# between points that other contacts hold together.
PUSH, LEAST_PUSH = 1e-13, 1e-15
# Relative to the largest force of a mode: rounding errors of the others, by the sums that all come
# from.
FORCE_OF_LARGEST = 1e-13
# Relative to velocities and forces in an impact: smaller ones are none.
NOTHING_LEFT = 1e-12
# Relative to velocities and forces of springs in an impact, which are sums over some thousand
# steps.
SPRING_ROUNDING = 1e-13
# Relative to a parameter, in the difference of a guard from which its rounding errors follow: a
# difference of this size keeps ten digits, and is small enough to be linear.
DIFFERENCE = 1e-6

# -- the smallest numbers ------------------------------------------------------------------------

# In place of zero where something is divided by a size.
LEAST_SIZE = 1e-300
# In place of an infinite margin that must not be compared with another one.
LARGEST = 1e300
# Products of lengths, times and velocities below it are no longer normal numbers.
LEAST_PRODUCT = 1e-290

# -- margins -------------------------------------------------------------------------------------

# Relative to the largest coefficient: the margin by which a polynomial must stay on one side of
# zero to have no root, or as many as its coefficients say.
#
# The quintic through both ends of a step misses the motion by at most (omega h)^6/46080 of its
# amplitude (Hermite's remainder: x^3 (1 - x)^3 <= 1/64, over 6!), where omega is the fastest
# frequency in it; that is below CLEAR up to omega h = 1.9. Eight samples of a guard on the quintics
# are nearer to it than the quintics are.
CLEAR = 1e-3
# Relative to the largest force: a combination of contacts that fits by it needs no comparison with
# others, all of which have forces that differ by as much.
CLEAR_FIT = 1e-3
# Relative to forces, impulses and velocities: what a candidate must fulfil, but for rounding errors
# of the elimination of up to eight unknowns, whose pivots are above PIVOT of the largest.
FITS = 1e-11
# Relative to forces and accelerations: by which the time of an event may be off at least.
NEARLY = 1e-9
# Relative to a force that holds a gap: it must be exceeded by so much before the gap closes
# instead.
MORE_THAN_HELD = 1e-11
# Relative to the largest force that may hold a gap: forces beyond it by less are as large.
BEYOND_MOST = 1e-9
# Relative to a slip: a point whose gap moves as fast as that is in a hop, and does not slide.
SLIP_WITH_HOP = 1e-3
# Relative to the squared largest number in two equations: a determinant above it loses at most six
# digits of the sixteen. Others go by elimination with pivots.
INDEPENDENT = 1e-6
# Relative to its third power in three equations, whose products have one more rounding error each.
INDEPENDENT_OF_THREE = 1e-4
# Relative to the largest number in some equations: rows below it say what others say, but for
# rounding.
PIVOT = 1e-12
# Relative to a diagonal element of the mass: what elimination leaves below it has no inertia of its
# own.
MASSLESS = 1e-13
# Relative to the mobility of two slips: below it both are one slip, as of two feet on level ground.
SAME_ROWS = 1e-12
# In the lever of friction: points farther apart than that share friction by their fractions.
APART = 1e-9
# Relative to ground accelerations: segments that differ by less meet, but for rounding of their
# ends.
JUMP_OF_GROUND = 1e-10
# Relative to the forces of all feet: each must be above it for the structure to stand still.
STAYS_ON_FEET = 1e-9
# Relative to the rates on both sides of an event: where they differ by less, nothing changes there.
SAME_RATES = 1e-8
# Relative to the rates of points that land alike, which differ by rounding: some 1e-15 in a step.
SAME_LANDING_RATE = 1e-9
# Relative to the kinetic energy: velocities after an impact that differ by less are the same.
SAME_VELOCITIES = 1e-18

# -- sizes that count as none --------------------------------------------------------------------

# Relative to a given state: one of seven digits, or of a motion with rtol 1e-6, is so far from
# exact.
GIVEN = 1e-6
# Relative to the size of a structure: a point of a given state that is higher is open.
NO_GAP = 1e-9
# Relative to what a point falls in a flight: a gap that is left below it has closed in the flight,
# too.
NO_DROP = 1e-9
# Relative to the way of a gap in a step: a point that close touches at the landing of another one.
NO_GAP_IN_STEP = 1e-9
# The same, of the terms of the gap, for points that do not move.
NO_GAP_OF_TERMS = 1e-13
# Relative to the way of a gap in a step, or of a guard: beyond it another guard has fallen before.
PASSED = 1e-9
# Relative to the size of a structure: what opens between closer points is LEAST_PUSH.
CLOSEST = 1e-7
# In units of sqrt(a l): slower points of a given state do not move, whatever else does.
NO_MOTION = 1e-8
# In the same units: a slip of an idle point that is nothing but rounding of a structure at rest.
NO_SLIP = 1e-10
# Rate of a rotation that points hold [rad/s], and its rate [rad/s2]: rounding errors.
NO_TURN = 1e-14
# In units of sqrt(a l): the speed of landings between whose outcomes nothing decides.
SLOW = 1e-6
# In units of sqrt(l/a): the time of lost flights that is summed.
LONGEST_LOST = 1e-5
# Relative to the terms of a gap: lower flights are lost among rounding errors.
LOST_HOP = 1e-13
# Relative to the radius of gyration l: so low a flight ends in no time, 3e-9 of sqrt(l/a).
NO_HOP = 1e-18
# Relative to the rate of bounces at their start, and of the fastest point: slower bounces have
# ended, since the time of those to come is in proportion to their rates.
ENDED, ENDED_OF_ALL = 1e-7, 1e-8
# Relative to the time of the flights so far: the last one of points whose bounces have ended.
ENDED_FLIGHT = 1e-6
# Relative to the loss in a period of bounces: periods that differ by less are a geometric series,
# whose sum is then as exact.
STEADY = 1e-9
# Relative to the velocity at the first of infinitely many impacts: what changes by less from one
# flight to the next changes the sum of all to come by as little.
FADED = 1e-13
# In units of sqrt(l/a): the rest tolerance of a motion that is followed on after the ground rests.
REST_AFTER_MOTION = 1e-6
# Relative to a tilt: a free motion that leaned so much further than at its ends has turned back.
TURNED_BACK = 1e-6
# Relative to the weight's potential energy: a structure at rest has less kinetic energy.
AT_REST = 1e-9
# In parts of a step: parts of a polynomial are halved down to it, 43 times.
NARROWEST = 1e-13
# Relative to the tolerances: a smaller state, or rate, does not say how long a step may be.
SMALL_STATE = 1e-5

# -- moves after which an iteration has ended ----------------------------------------------------

# Newton's method: the error left is about the square of its last move
SETTLED_CLOSING = 1e-7  # of the closing of a gap: 1e-14 of a step
SETTLED_FALL = 1e-10  # of the fall of any guard, which may bend more than a gap does
SETTLED_EXTREME = 1e-9  # of an extreme, whose value has an error of the square of that of its place
SETTLED_IN_LANES = 1e-4  # of the closing of a gap in lanes, after which the step is repeated
SETTLED_SPRINGS = 1e-15  # of an instant in the step of springs, by the last digits
SETTLED_PARABOLA = 1e-6  # of a step: a fall so near to its ends is none that a parabola tells of

# A step that is to end on an event In parts of a step times rtol: by less the end is not corrected,
# since states are known no better.
PLACED = 1e-5
# In parts of a step, squared: the end may be moved on the quintic by the square root of rtol,
# within these bounds: the error of that is of the square of the move.
PLACED_BY_QUINTIC, LEAST_OF_QUINTIC = 1e-6, 1e-13
# In parts of a step in lanes: a landing may miss the impact by it. A Taylor series of the second
# order passes the rest, with an error of the third power.
PLACED_IN_LANES = 1e-8
# In parts of the step as planned: it is shortened down to that where a guard is not where it was
# put.
SHORTEST_PART = 1e-6
# [s] a first step where the state does not say how long it may be.
SHORTEST_FIRST = 1e-6
# Relative to the tolerance of a step: smaller errors do not lengthen the next step any more.
LEAST_ERROR = 1e-10
# Relative to the rates in a step: by so much a coordinate that turns at an end of it may miss its
# extreme, which is off by the square of that.
TURN_MISS = 1e-5
# The same of a rate, by the range of rates of the whole motion.
RATE_TURN = 1e-6

# -- steps by which something is looked at -------------------------------------------------------

# In parts of a step times rtol: by which an event's time may be off; a guard must still be below
# zero.
LOOK_AHEAD = 1e-4
# In parts of a step: beside an event a polynomial is looked at from there on, each time twice as
# far.
LOOK_BESIDE = 1e-6
# In parts of a step of springs: after which it is chosen which of them act.
SOON = 1e-6
# In parts of a step: after which forces decide between modes that move alike at an event.
SOON_IN_STEP = 1e-5
# Relative to the force that holds a structure: that of a slip for which no step is short enough.
JAMMED = 10.0
# [m/s, rad/s] the most of the velocity with which a slip in space begins, so that it has a
# direction. It is the error of a state after many steps, since the motion keeps it for good.
FIRST_SLIP = 1e-8
# [m/s] the least of it, and of the slowest of several; the most of the fastest for its sake.
LEAST_FIRST_SLIP, MOST_FIRST_SLIP = 1.5e-13, 1e-7
# [m/s] the most of that with which it ends, or rtol: a slower one has no direction left.
SPEED_AT_STOP = 1e-10
# [s] the first step after it begins: a longer one, which is not stable, makes much of rounding.
FIRST_STEP_OF_SLIP = 1e-6
# In LEAST_PART_OF_TURN of the fastest slip that begins: a slower one is that of a point about which
# others turn, for which it stands.
A_PIVOT = 2.0
# Relative to how a point yields along the ground: the direction of a slip that begins is known.
SAME_DIRECTION = 1e-13
# Relative to how freely a point moves: it yields by so much at least where it is about to slip.
LEAST_YIELD = 1e-9
# Relative: by which yields differ for the slopes of Newton's method.
OF_YIELDS = 1e-5
# Relative change of impulses in a sweep over all points: they have come to their end.
SWEPT = 1e-12
# Relative, of the friction that points would need to stick: so close to it they are about to slip.
ABOUT_TO_SLIP = 1e-3
# Relative to accelerations: what rounding leaves of that of a slip that just begins.
FROM_REST = 1e-7
# Relative to friction: the direction of a slip that just begins does not depend on so little of it.
JUST_SLIPS = 1e-5
# [m/s] a slip in space that has come to its end, and has not only turned.
STOPPED = 1e-8
# Relative to a flight of a bounce: the same after a landing, in a time that is itself short.
SOON_IN_FLIGHT = 1e-3
# [s] the same after a rest, and at the start of a motion, whose states are exact.
SOON_AT_REST, SOON_AT_START = 1e-6, 1e-9
# In parts of a step: by which it is seen how the rate of a guard changes, for `DIGITS`.
BEND_OF_GUARD = 1e-3
# Relative to a state, and of a small one: the steps of central differences for the Jacobian of
# Radau, whose errors are of the square of a step, and of EPS over it.
JACOBIAN_STEP, LEAST_JACOBIAN_STEP = 1e-6, 1e-7
