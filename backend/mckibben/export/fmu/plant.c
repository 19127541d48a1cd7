/* One instance of the model: its inputs, switches and derivatives. */
#include "plant.h"

#include <math.h>
#include <string.h>

void plant_reset(plant *it)
{
    memset(it, 0, sizeof *it);
    memcpy(it->y, model_start, sizeof it->y);
    memcpy(it->w, model_start_switches, sizeof it->w);
    memcpy(it->p, model_parameters, sizeof it->p);
    memcpy(it->u, model_start_inputs, sizeof it->u);
    it->tolerance = 1e-7;
    it->step = 1e-4;
}

void plant_prepare(plant *it)
{
    if (!it->prepared) {
        model_prepare(it->p, it->k);
        it->prepared = 1;
    }
}

void plant_inputs(const plant *it, double time, double *u)
{
    for (int i = 0; i < MODEL_INPUTS; ++i) {
        u[i] = it->u[i] + it->u_rate[i] * (time - it->u_time);
        if (it->play && model_played[i]) {
            const double *row = model_pieces[it->piece];
            u[i] = row[1 + 2 * i] + row[2 + 2 * i] * (time - row[0]);
        }
    }
}

void plant_input_rates(const plant *it, double *rates)
{
    for (int i = 0; i < MODEL_INPUTS; ++i) {
        rates[i] = it->play && model_played[i] ? model_pieces[it->piece][2 + 2 * i] : it->u_rate[i];
    }
}

void plant_enter_piece(plant *it)
{
#if MODEL_PIECES > 1
    const double now = it->time + 1e-12 * (1.0 + fabs(it->time));
    while (it->piece > 0 && now < model_pieces[it->piece][0]) {
        --it->piece;
    }
    while (it->piece + 1 < MODEL_PIECES && now >= model_pieces[it->piece + 1][0]) {
        ++it->piece;
    }
#else
    it->piece = 0;
#endif
}

double plant_next_piece(const plant *it)
{
#if MODEL_PIECES > 1
    if (it->play && it->piece + 1 < MODEL_PIECES) {
        return model_pieces[it->piece + 1][0];
    }
#endif
    (void)it;
    return HUGE_VAL;
}

int plant_settle(plant *it)
{
    double guards[PLANT_ROOM(MODEL_SWITCHES)], u[PLANT_ROOM(MODEL_INPUTS)];
    int changed = 0;
    plant_prepare(it);
    plant_inputs(it, it->time, u);
    for (int round = 0; round < 2 * MODEL_SWITCHES + 1; ++round) {
        int wrong = -1;
        model_guards(it->y, it->k, u, it->w, guards);
        for (int i = MODEL_SWITCHES - 1; i >= 0; --i) {
            /* A root of the indicator may be met exactly. */
            if (guards[i] + MODEL_LEAST <= 0.0) {
                wrong = i;
            }
        }
        if (wrong < 0) {
            break;
        }
        model_change(wrong, it->p, it->k, u, it->y, it->w);
        changed = 1;
    }
    return changed;
}

#if !MODEL_EXACT_DERIVATIVES
/* Central differences by one argument, which is restored. */
static void differences(const double *y, const double *k, const double *u, const double *w, double *argument,
                        double scale, double *matrix, int width)
{
    double above[PLANT_ROOM(MODEL_STATES)], below[PLANT_ROOM(MODEL_STATES)];
    const double middle = *argument;
    const double step = 1e-6 * (fabs(middle) > scale ? fabs(middle) : scale);
    *argument = middle + step;
    model_rates(y, k, u, w, above);
    *argument = middle - step;
    model_rates(y, k, u, w, below);
    *argument = middle;
    for (int row = 0; row < MODEL_STATES; ++row) {
        matrix[row * width] = (above[row] - below[row]) / (2.0 * step);
    }
}
#endif

void plant_jacobian(const double *y, const double *k, const double *u, const double *w, double *matrix)
{
#if MODEL_EXACT_DERIVATIVES
    model_jacobian(y, k, u, w, matrix);
#else
    double moved[PLANT_ROOM(MODEL_STATES)];
    memcpy(moved, y, sizeof moved);
    for (int i = 0; i < MODEL_STATES; ++i) {
        differences(moved, k, u, w, moved + i, model_scales[i], matrix + i, MODEL_STATES);
    }
#endif
}

void plant_input_jacobian(const double *y, const double *k, const double *u, const double *w, double *matrix)
{
#if MODEL_EXACT_DERIVATIVES
    model_input_jacobian(y, k, u, w, matrix);
#else
    double moved[PLANT_ROOM(MODEL_INPUTS)];
    memcpy(moved, u, sizeof moved);
    for (int i = 0; i < MODEL_INPUTS; ++i) {
        differences(y, k, moved, w, moved + i, 1e-3, matrix + i, MODEL_INPUTS);
    }
#endif
}
