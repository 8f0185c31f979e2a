/* The distances from one point to segments and discs, along rays that are spread evenly over a turn.
 *
 * An obstacle is met only by the rays inside the angle under which it is seen, and only these are worked on.
 * Lengths are in m, angles in rad; ray 0 points along yaw, the others follow counter-clockwise.
 */
#include <math.h>

/* Rays this near (in ray spacings) to a wall's end still meet it: none passes through a shared corner. */
static const double EDGE = 1e-9;
/* A wall seen end-on, under less than this angle, is invisible: its distance would be rounding noise. */
static const double END_ON = 1e-6;
static const double TURN = 6.283185307179586;

/* Where the rays start and point. unit: (cos, sin) of each ray's angle to ray 0, whose own are c and s. */
struct rays {
    long count;
    const double *unit;
    double x, y, yaw, c, s;
};

/* The rays, from begin to end, that meet what fills the angles first .. first + width, counted from ray 0. */
static void meet(const struct rays *rays, double first, double width, long *begin, long *end)
{
    double spacing = TURN / rays->count;
    *begin = (long)ceil(first / spacing - EDGE);
    *end = (long)floor((first + width) / spacing + EDGE);
}

static long around(const struct rays *rays, long ray)
{
    long index = ray % rays->count;
    return index < 0 ? index + rays->count : index;
}

static double east(const struct rays *rays, long i)
{
    return rays->unit[2 * i] * rays->c - rays->unit[2 * i + 1] * rays->s;
}

static double north(const struct rays *rays, long i)
{
    return rays->unit[2 * i + 1] * rays->c + rays->unit[2 * i] * rays->s;
}

static void see_segment(const struct rays *rays, const double *ends, double *nearest)
{
    double ex = ends[2] - ends[0], ey = ends[3] - ends[1];
    double ax = ends[0] - rays->x, ay = ends[1] - rays->y, bx = ax + ex, by = ay + ey;
    double seen = atan2(ax * by - ay * bx, ax * bx + ay * by), area = ax * ey - ay * ex;
    long begin, end;
    if (!(fabs(seen) > END_ON))
        return;
    meet(rays, atan2(ay, ax) - rays->yaw + fmin(seen, 0), fabs(seen), &begin, &end);
    for (long ray = begin; ray <= end; ray++) {
        long i = around(rays, ray);
        nearest[i] = fmin(nearest[i], area / (east(rays, i) * ey - north(rays, i) * ex));
    }
}

static void see_disc(const struct rays *rays, const double *disc, double *nearest)
{
    double cx = disc[0] - rays->x, cy = disc[1] - rays->y, radius = disc[2];
    double beyond = cx * cx + cy * cy - radius * radius;
    long begin, end;
    if (!(beyond > 0)) /* one around the point itself is not seen */
        return;
    double half = atan2(radius, sqrt(beyond));
    meet(rays, atan2(cy, cx) - rays->yaw - half, 2 * half, &begin, &end);
    for (long ray = begin; ray <= end; ray++) {
        long i = around(rays, ray);
        double along = east(rays, i) * cx + north(rays, i) * cy;
        /* A ray along the very edge can round to just below zero. */
        nearest[i] = fmin(nearest[i], along - sqrt(fmax(along * along - beyond, 0)));
    }
}

/* For each ray, the distance to what it meets first of the segments (x0, y0, x1, y1) and the discs
 * (x, y, radius); infinity where it meets nothing. nearest and unit have room for so many rays.
 */
void see(double *nearest, const double *unit, long rays, const double *segments, long segment_count,
         const double *discs, long disc_count, double x, double y, double yaw)
{
    struct rays from = {rays, unit, x, y, yaw, cos(yaw), sin(yaw)};
    for (long i = 0; i < rays; i++)
        nearest[i] = INFINITY;
    for (long i = 0; i < segment_count; i++)
        see_segment(&from, segments + 4 * i, nearest);
    for (long i = 0; i < disc_count; i++)
        see_disc(&from, discs + 3 * i, nearest);
}

/* What a lidar reads at these distances. normal: the noise of each ray in standard deviations, of which one is
 * `noise`. Infinity: nothing within range_max; -infinity: something nearer than range_min.
 */
void read_ranges(float *ranges, const double *distances, const double *normal, long rays, double noise,
                 double range_min, double range_max)
{
    for (long i = 0; i < rays; i++) {
        double range = distances[i] + noise * normal[i];
        ranges[i] = range > range_max ? INFINITY : range < range_min ? -INFINITY : (float)range;
    }
}
