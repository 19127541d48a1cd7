/* Variables, derivatives and steps of one plant, for any version of FMI. */
#include "access.h"

#include <math.h>

static plant *prepared(plant *it)
{
    plant_prepare(it);
    return it;
}

/* All outputs, or all rates, or all event indicators. */
static void outputs_of(plant *it, double *out)
{
    double u[PLANT_ROOM(MODEL_INPUTS)];
    plant_inputs(it, it->time, u);
    model_outputs(it->y, it->p, it->k, u, it->w, out);
}

static void rates_of(plant *it, double *rates)
{
    double u[PLANT_ROOM(MODEL_INPUTS)];
    plant_inputs(it, it->time, u);
    model_rates(it->y, it->k, u, it->w, rates);
}

static void indicators_of(plant *it, double *indicators)
{
    double u[PLANT_ROOM(MODEL_INPUTS)];
    plant_inputs(it, it->time, u);
    model_guards(it->y, it->k, u, it->w, indicators);
    for (int i = 0; i < MODEL_SWITCHES; ++i) {
        indicators[i] += MODEL_LEAST;
    }
}

/* Where a value that can be set is; NULL for none. */
static double *place_of(plant *it, unsigned reference)
{
    const int number = (int)(reference % KIND);
    switch (reference / KIND) {
    case STATE:
        return number < MODEL_STATES ? &it->y[number] : NULL;
    case PARAMETER:
        return number < MODEL_PARAMETERS ? &it->p[number] : NULL;
    case INPUT:
        return number < MODEL_INPUTS ? &it->u[number] : NULL;
    case SWITCH:
        return number < MODEL_SWITCHES ? &it->w[number] : NULL;
    default:
        return NULL;
    }
}

const char *plant_get(plant *it, const unsigned references[], size_t count, double values[])
{
    double out[PLANT_ROOM(MODEL_OUTPUTS)], rates[PLANT_ROOM(MODEL_STATES)], u[PLANT_ROOM(MODEL_INPUTS)];
    double indicators[PLANT_ROOM(MODEL_SWITCHES)];
    int have_out = 0, have_rates = 0;
    prepared(it);
    for (size_t i = 0; i < count; ++i) {
        const int kind = (int)(references[i] / KIND), number = (int)(references[i] % KIND);
        const double *place = place_of(it, references[i]);
        if (kind == OUTPUT && number < MODEL_OUTPUTS) {
            if (!have_out) {
                outputs_of(it, out);
                have_out = 1;
            }
            values[i] = out[number];
        } else if (kind == RATE && number < MODEL_STATES) {
            if (!have_rates) {
                rates_of(it, rates);
                have_rates = 1;
            }
            values[i] = rates[number];
        } else if (kind == INDICATOR && number < MODEL_SWITCHES) {
            indicators_of(it, indicators);
            values[i] = indicators[number];
        } else if (kind == INPUT && place != NULL) {
            plant_inputs(it, it->time, u);
            values[i] = u[number];
        } else if (references[i] == TIME) {
            values[i] = it->time;
        } else if (place != NULL) {
            values[i] = *place;
        } else {
            return "there is no real number of this value reference";
        }
    }
    return NULL;
}

const char *plant_set(plant *it, const unsigned references[], size_t count, const double values[])
{
    for (size_t i = 0; i < count; ++i) {
        double *place = place_of(it, references[i]);
        const int kind = (int)(references[i] / KIND);
        if (place == NULL) {
            return "there is no real number of this value reference that can be set";
        }
        if (!isfinite(values[i])) {
            return "a value that is not finite cannot be set";
        }
        *place = values[i];
        if (kind == PARAMETER) {
            it->prepared = 0;
        }
        if (kind == INPUT) {
            it->u_rate[references[i] % KIND] = 0.0;
        }
    }
    return NULL;
}

static const char wrong_states[] = "wrong number of states";

const char *plant_get_states(const plant *it, double states[], size_t count)
{
    if (count != MODEL_STATES) {
        return wrong_states;
    }
    for (size_t i = 0; i < count; ++i) {
        states[i] = it->y[i];
    }
    return NULL;
}

const char *plant_set_states(plant *it, const double states[], size_t count)
{
    if (count != MODEL_STATES) {
        return wrong_states;
    }
    for (size_t i = 0; i < count; ++i) {
        it->y[i] = states[i];
    }
    return NULL;
}

const char *plant_get_rates(plant *it, double rates[], size_t count)
{
    double all[PLANT_ROOM(MODEL_STATES)];
    if (count != MODEL_STATES) {
        return wrong_states;
    }
    rates_of(prepared(it), all);
    for (size_t i = 0; i < count; ++i) {
        rates[i] = all[i];
    }
    return NULL;
}

const char *plant_get_nominals(double nominals[], size_t count)
{
    if (count != MODEL_STATES) {
        return wrong_states;
    }
    for (size_t i = 0; i < count; ++i) {
        nominals[i] = model_scales[i];
    }
    return NULL;
}

const char *plant_get_indicators(plant *it, double indicators[], size_t count)
{
    double all[PLANT_ROOM(MODEL_SWITCHES)];
    if (count != MODEL_SWITCHES) {
        return "wrong number of event indicators";
    }
    indicators_of(prepared(it), all);
    for (size_t i = 0; i < count; ++i) {
        indicators[i] = all[i];
    }
    return NULL;
}

/* Where a known of a directional derivative is, and the scale of its differences. */
static double *known_of(plant *it, unsigned reference, double *scale)
{
    double *place = place_of(it, reference);
    *scale = place == NULL ? 0.0 : fmax(fabs(*place), 1e-3);
    if (place != NULL && reference / KIND == STATE) {
        *scale = fmax(fabs(*place), model_scales[reference % KIND]);
    }
    return place;
}

const char *plant_directional(plant *it, const unsigned unknowns[], size_t unknown_count,
                              const unsigned knowns[], size_t known_count, const double known_changes[],
                              double changes[])
{
    plant moved = *prepared(it);
    double u[PLANT_ROOM(MODEL_INPUTS)], above[PLANT_ROOM(MODEL_OUTPUTS)], below[PLANT_ROOM(MODEL_OUTPUTS)];
    double jacobian[PLANT_ROOM(MODEL_STATES * MODEL_STATES)];
    double by_inputs[PLANT_ROOM(MODEL_STATES * MODEL_INPUTS)];
    plant_inputs(it, it->time, u);
    plant_jacobian(it->y, it->k, u, it->w, jacobian);
    plant_input_jacobian(it->y, it->k, u, it->w, by_inputs);
    for (size_t i = 0; i < unknown_count; ++i) {
        const int kind = (int)(unknowns[i] / KIND), row = (int)(unknowns[i] % KIND);
        if (!((kind == RATE && row < MODEL_STATES) || (kind == OUTPUT && row < MODEL_OUTPUTS))) {
            return "there is no derivative of this value reference";
        }
        changes[i] = 0.0;
    }
    for (size_t j = 0; j < known_count; ++j) {
        const int kind = (int)(knowns[j] / KIND), column = (int)(knowns[j] % KIND);
        double scale;
        double *place = known_of(&moved, knowns[j], &scale);
        if (place == NULL || (kind != STATE && kind != INPUT)) {
            return "there is no derivative by this value reference";
        }
        if (known_changes[j] == 0.0 || (kind == INPUT && it->play && model_played[column])) {
            continue; /* an input that the document plays does not depend on its value */
        }
        const double middle = *place, step = 1e-6 * scale;
        *place = middle + step;
        outputs_of(&moved, above);
        *place = middle - step;
        outputs_of(&moved, below);
        *place = middle;
        for (size_t i = 0; i < unknown_count; ++i) {
            const int row = (int)(unknowns[i] % KIND);
            double slope;
            if (unknowns[i] / KIND == OUTPUT) {
                slope = (above[row] - below[row]) / (2.0 * step);
            } else if (kind == STATE) {
                slope = jacobian[PLANT_ROOM(row * MODEL_STATES + column + 1) - 1];
            } else {
                slope = by_inputs[PLANT_ROOM(row * MODEL_INPUTS + column + 1) - 1];
            }
            changes[i] += slope * known_changes[j];
        }
    }
    return NULL;
}

const char *plant_begin(plant *it, double start, int stated, double tolerance)
{
    it->time = it->u_time = start;
    if (stated && !(tolerance > 0.0)) {
        return "the tolerance must be above 0";
    }
    if (stated) {
        /* At more than 1e-5 a step may jump over the moment at which a load leaves its stop. */
        it->tolerance = fmax(1e-12, fmin(1e-5, tolerance));
    }
    return NULL;
}

const char *plant_step(plant *it, double now, double size)
{
    static const char *const why[] = {
        NULL, "the step became too small", "the solution is not finite", "a switch chatters",
        "a million steps do not reach the end: is a parameter far from what it stands for?"};
    if (fabs(now - it->time) > 1e-9 * (1.0 + fabs(now))) {
        return "the step does not begin where the last one ended";
    }
    if (!(size >= 0.0)) {
        return "the size of a step must not be negative";
    }
    const int status = plant_advance(it, now + size);
    for (int i = 0; i < MODEL_INPUTS; ++i) {
        it->u[i] += it->u_rate[i] * (it->time - it->u_time);
        it->u_rate[i] = 0.0;
    }
    it->u_time = it->time;
    return why[status];
}
