/* The solver of co-simulation: Rodas4, a stiff Rosenbrock method, with switches located within its steps.
 *
 * Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.7: six stages, order 4 with an
 * embedded order 3, L-stable, dense output of order 3. Where a guard falls below -MODEL_LEAST the step is
 * repeated up to that instant, and the switch changes there. All memory is on the stack.
 */
#include "plant.h"
#include "rodas4.h"

#include <math.h>
#include <string.h>

enum { N = PLANT_ROOM(MODEL_STATES), W = PLANT_ROOM(MODEL_SWITCHES), U = PLANT_ROOM(MODEL_INPUTS) };
/* Switches that change more often between two calls make the model chatter. */
enum { MOST_CHANGES = 10000 };
enum { MOST_TRIES = 1000000 }; /* of steps, in one call or piece of the inputs */

typedef struct {
    double start[N], end[N], stages[6][N], dense[2][N];
    double t, h;
} step_of;

/* Factors in place with pivoting; 0 when the matrix is singular. */
static int factorised(double a[N][N], int *pivots)
{
    for (int k = 0; k < MODEL_STATES; ++k) {
        int best = k;
        for (int i = k + 1; i < MODEL_STATES; ++i) {
            if (fabs(a[i][k]) > fabs(a[best][k])) {
                best = i;
            }
        }
        pivots[k] = best;
        if (!(fabs(a[best][k]) > 0.0)) {
            return 0;
        }
        if (best != k) {
            for (int j = 0; j < MODEL_STATES; ++j) {
                const double kept = a[k][j];
                a[k][j] = a[best][j];
                a[best][j] = kept;
            }
        }
        for (int i = k + 1; i < MODEL_STATES; ++i) {
            const double factor = a[i][k] / a[k][k];
            a[i][k] = factor;
            if (factor != 0.0) {
                for (int j = k + 1; j < MODEL_STATES; ++j) {
                    a[i][j] -= factor * a[k][j];
                }
            }
        }
    }
    return 1;
}

static void solve(double a[N][N], const int *pivots, double *x)
{
    for (int k = 0; k < MODEL_STATES; ++k) {
        const double kept = x[pivots[k]];
        x[pivots[k]] = x[k];
        x[k] = kept;
    }
    for (int i = 1; i < MODEL_STATES; ++i) {
        for (int j = 0; j < i; ++j) {
            x[i] -= a[i][j] * x[j];
        }
    }
    for (int i = MODEL_STATES - 1; i >= 0; --i) {
        for (int j = i + 1; j < MODEL_STATES; ++j) {
            x[i] -= a[i][j] * x[j];
        }
        x[i] /= a[i][i];
    }
}

/* One trial step; its weighted error. */
static double tried(const plant *it, step_of *s)
{
    double jacobian[N * N], by_inputs[N * U], matrix[N][N], u[U], u_rates[U], timed[N], rates[N], trial[N];
    int pivots[N];
    double error = 0.0;
    plant_inputs(it, s->t, u);
    plant_input_rates(it, u_rates);
    plant_jacobian(s->start, it->k, u, it->w, jacobian);
    plant_input_jacobian(s->start, it->k, u, it->w, by_inputs);
    for (int i = 0; i < MODEL_STATES; ++i) {
        timed[i] = 0.0;
        for (int j = 0; j < MODEL_INPUTS; ++j) {
            timed[i] += u_rates[j] == 0.0 ? 0.0 : by_inputs[i * MODEL_INPUTS + j] * u_rates[j];
        }
        for (int j = 0; j < MODEL_STATES; ++j) {
            matrix[i][j] = (i == j ? 1.0 / (RODAS_GAMMA * s->h) : 0.0) - jacobian[i * MODEL_STATES + j];
        }
    }
    if (!factorised(matrix, pivots)) {
        return HUGE_VAL;
    }
    memcpy(trial, s->start, sizeof trial);
    for (int stage = 0; stage < 6; ++stage) {
        double *own = s->stages[stage];
        for (int i = 0; i < MODEL_STATES; ++i) {
            trial[i] = s->start[i];
            for (int j = 0; j < stage; ++j) {
                trial[i] += RODAS_A[stage][j] * s->stages[j][i];
            }
        }
        plant_inputs(it, s->t + RODAS_ALPHA[stage] * s->h, u);
        model_rates(trial, it->k, u, it->w, rates);
        for (int i = 0; i < MODEL_STATES; ++i) {
            double total = 0.0;
            for (int j = 0; j < stage; ++j) {
                total += RODAS_C[stage][j] * s->stages[j][i];
            }
            own[i] = rates[i] + total / s->h + RODAS_DELTA[stage] * s->h * timed[i];
        }
        solve(matrix, pivots, own);
    }
    for (int i = 0; i < MODEL_STATES; ++i) {
        s->end[i] = trial[i] + s->stages[5][i];
        const double larger = fmax(fabs(s->start[i]), fabs(s->end[i]));
        const double share = s->stages[5][i] / (it->tolerance * (model_scales[i] + larger));
        error += share * share;
    }
    return sqrt(error / PLANT_ROOM(MODEL_STATES));
}

static void write_dense(step_of *s)
{
    for (int i = 0; i < MODEL_STATES; ++i) {
        s->dense[0][i] = s->dense[1][i] = 0.0;
        for (int j = 0; j < 5; ++j) {
            s->dense[0][i] += RODAS_DENSE_2[j] * s->stages[j][i];
            s->dense[1][i] += RODAS_DENSE_3[j] * s->stages[j][i];
        }
    }
}

static double interpolated(const step_of *s, int i, double share)
{
    const double bent = s->dense[0][i] + share * s->dense[1][i];
    return s->start[i] * (1.0 - share) + share * (s->end[i] + (1.0 - share) * bent);
}

/* A guard plus its least value, at a share of the step. */
static double guard_at(const plant *it, const step_of *s, double share, int number)
{
    double y[N], u[U], guards[W];
    for (int i = 0; i < MODEL_STATES; ++i) {
        y[i] = interpolated(s, i, share);
    }
    plant_inputs(it, s->t + share * s->h, u);
    model_guards(y, it->k, u, it->w, guards);
    return guards[number] + MODEL_LEAST;
}

#if MODEL_SPEED >= 0
/* Share of the step at which a speed that changes its sign is zero, by bisection. */
static double turning(const step_of *s, int i)
{
    double low = 0.0, high = 1.0;
    for (int round = 0; round < 40; ++round) {
        const double middle = 0.5 * (low + high);
        *(interpolated(s, i, middle) * s->start[i] > 0.0 ? &low : &high) = middle;
    }
    return low;
}

/* Share of the step at which a speed, times its sense, is smallest and negative inside of it; 0 if nowhere. */
static double backmost(const step_of *s, int i, int sense)
{
    const double a = -3.0 * s->dense[1][i], b = 2.0 * (s->dense[1][i] - s->dense[0][i]);
    const double c = s->end[i] - s->start[i] + s->dense[0][i], inside = b * b - 4.0 * a * c;
    double found = 0.0, least = 0.0;
    if (inside >= 0.0) {
        const double q = -0.5 * (b + (b > 0.0 ? sqrt(inside) : -sqrt(inside)));
        const double roots[2] = {a != 0.0 ? q / a : -1.0, q != 0.0 ? c / q : -1.0};
        for (int root = 0; root < 2; ++root) {
            if (roots[root] > 0.0 && roots[root] < 1.0) {
                const double value = sense * interpolated(s, i, roots[root]);
                if (value < least) {
                    found = roots[root];
                    least = value;
                }
            }
        }
    }
    return found;
}
#endif

/* Share of the step at which a guard that is violated at ``high`` falls below, by the Illinois method. */
static double crossing(const plant *it, const step_of *s, int number, double high)
{
    double low = 0.0, at_low = guard_at(it, s, 0.0, number), at_high = guard_at(it, s, high, number);
    int side = 0;
    if (at_low <= 0.0) {
        return 0.0;
    }
    for (int round = 0; round < 60 && high - low > 1e-12; ++round) {
        const double middle = (low * at_high - high * at_low) / (at_high - at_low);
        const double value = guard_at(it, s, middle, number);
        if (fabs(value) <= 0.5 * MODEL_LEAST) {
            return middle;
        }
        if (value < 0.0) {
            high = middle;
            at_high = value;
            at_low *= side < 0 ? 0.5 : 1.0;
            side = -1;
        } else {
            low = middle;
            at_low = value;
            at_high *= side > 0 ? 0.5 : 1.0;
            side = 1;
        }
    }
    return high;
}

/* The switch that changes first within the step and where, as a share of it; -1 for none. */
static int first_event(const plant *it, step_of *s, double *share)
{
    double turn = 0.0;
    int first = -1;
    *share = 2.0;
    write_dense(s);
#if MODEL_SPEED >= 0
    if (s->start[MODEL_SPEED] * s->end[MODEL_SPEED] < 0.0) {
        /* A load that turns round within the step may have touched a stop. */
        turn = turning(s, MODEL_SPEED);
    }
#endif
    for (int i = 0; i < MODEL_SWITCHES; ++i) {
        double high = 0.0;
        if (guard_at(it, s, 1.0, i) < 0.0) {
            high = 1.0;
        } else if (turn > 0.0 && it->w[i] == 0.0 && model_is_stop[i] && guard_at(it, s, turn, i) < 0.0) {
            high = turn;
        }
#if MODEL_SPEED >= 0
        if (high == 0.0 && model_slides[i] != 0 && it->w[i] == 1.0) {
            /* A load that has all but come to rest within the step may have stuck there. */
            const double slowest = backmost(s, MODEL_SPEED, model_slides[i]);
            if (slowest > 0.0 && guard_at(it, s, slowest, i) < 0.0) {
                high = slowest;
            }
        }
        for (int part = 1; part < 4 && high == 0.0 && model_slides[i] != 0 && it->w[i] == 0.0; ++part) {
            /* One that sticks may have been pulled beyond its range only within the step. */
            if (guard_at(it, s, 0.25 * part, i) < 0.0) {
                high = 0.25 * part;
            }
        }
#endif
        if (high > 0.0) {
            const double at = crossing(it, s, i, high);
            if (at < *share) {
                *share = at;
                first = i;
            }
        }
    }
    return first;
}

/* Between two pieces of the inputs. */
static int advance_piece(plant *it, double end)
{
    step_of s;
    int landing = -1, failed = 0, changes = 0;
    long tries = 0;
    double h = it->step, after_landing = h;
    plant_settle(it);
    while (it->time < end) {
        const double smallest = 1e-13 * fmax(1.0, fabs(it->time)), wanted = h;
        const int last = it->time + 1.0000001 * h >= end;
        double error, factor, share;
        if (changes > MOST_CHANGES) {
            return PLANT_CHATTERS;
        }
        if (++tries > MOST_TRIES) {
            return PLANT_TOO_STIFF;
        }
        s.t = it->time;
        s.h = h = last ? end - it->time : h;
        memcpy(s.start, it->y, sizeof s.start);
        memcpy(s.end, it->y, sizeof s.end);
        error = tried(it, &s);
        if (!(error < 1e10)) {
            error = 1e10;
        }
        factor = error > 0.0 ? fmin(6.0, fmax(0.2, 0.9 * pow(error, -0.25))) : 6.0;
        if (error > 1.0) {
            failed = 1;
            landing = -1;
            h *= factor;
            if (h < smallest) {
                return error >= 1e10 ? PLANT_NOT_FINITE : PLANT_STEP_TOO_SMALL;
            }
            continue;
        }
        if (landing < 0) {
            landing = first_event(it, &s, &share);
            if (landing >= 0 && share * h > smallest) {
                h *= share;
                after_landing = wanted;
                continue;
            }
            if (landing >= 0) {
                double u[U];
                plant_inputs(it, it->time, u);
                model_change(landing, it->p, it->k, u, it->y, it->w);
                plant_settle(it);
                landing = -1;
                ++changes;
                h = wanted;
                continue;
            }
        } else {
            /* The dense output of a long step may dip where the motion does not: the switch stays. */
            double u[U], before[W], after[W];
            plant_inputs(it, s.t, u);
            model_guards(s.start, it->k, u, it->w, before);
            plant_inputs(it, s.t + h, u);
            model_guards(s.end, it->k, u, it->w, after);
            if (after[landing] > before[landing] && after[landing] > 0.0) {
                landing = -1;
            }
        }
        it->time = last ? end : it->time + h;
        memcpy(it->y, s.end, sizeof it->y);
        if (landing >= 0) {
            double u[U];
            plant_inputs(it, it->time, u);
            model_change(landing, it->p, it->k, u, it->y, it->w);
            plant_settle(it);
            landing = -1;
            ++changes;
            h = after_landing;
        } else {
            h *= failed ? fmin(factor, 1.0) : factor;
            if (last && !failed) {
                h = fmax(h, wanted);
            }
        }
        failed = 0;
    }
    it->step = h;
    return PLANT_DONE;
}

int plant_advance(plant *it, double end)
{
    int status = PLANT_DONE;
    plant_prepare(it);
    while (status == PLANT_DONE && it->time < end) {
        const double next = plant_next_piece(it);
        status = advance_piece(it, next < end ? next : end);
        plant_enter_piece(it);
    }
    return status;
}
