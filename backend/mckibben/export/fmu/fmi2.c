/* FMI 2.0 for model exchange and co-simulation around one plant. */
#include "fmi2.h"
#include "plant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Value references are a kind times KIND plus a number. */
enum { KIND = 100000, STATE = 1, RATE = 2, PARAMETER = 3, INPUT = 4, OUTPUT = 5, SWITCH = 6 };
enum { PLAY = 0 /* the only Boolean */ };

typedef struct {
    plant it;
    fmi2CallbackFunctions callbacks;
    fmi2Type type;
    int logging, initialising, entered;
    char name[128];
} instance;

static fmi2Status failed(const instance *own, fmi2Status status, const char *message)
{
    if (own->callbacks.logger != NULL) {
        own->callbacks.logger(own->callbacks.componentEnvironment, own->name, status,
                              status == fmi2Warning ? "logStatusWarning" : "logStatusError", "%s", message);
    }
    return status;
}

static plant *prepared(instance *own)
{
    plant_prepare(&own->it);
    return &own->it;
}

FMI2_EXPORT const char *FMI2(fmi2GetTypesPlatform)(void)
{
    return "default";
}

FMI2_EXPORT const char *FMI2(fmi2GetVersion)(void)
{
    return "2.0";
}

FMI2_EXPORT fmi2Component FMI2(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                    const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                                    fmi2Boolean logging)
{
    (void)resources;
    (void)visible;
    if (name == NULL || guid == NULL || callbacks == NULL) {
        return NULL;
    }
    instance *own = calloc(1, sizeof *own);
    if (own == NULL) {
        return NULL;
    }
    own->callbacks = *callbacks;
    own->type = type;
    own->logging = logging;
    strncpy(own->name, name, sizeof own->name - 1);
    plant_reset(&own->it);
    if (strcmp(guid, MODEL_GUID) != 0) {
        failed(own, fmi2Error, "the GUID is not that of the binary: modelDescription.xml is of another FMU");
        free(own);
        return NULL;
    }
    return own;
}

FMI2_EXPORT void FMI2(fmi2FreeInstance)(fmi2Component c)
{
    free(c);
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetDebugLogging)(fmi2Component c, fmi2Boolean on, size_t count,
                                     const fmi2String categories[])
{
    (void)count;
    (void)categories;
    ((instance *)c)->logging = on;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetupExperiment)(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                                     fmi2Real start, fmi2Boolean stopDefined, fmi2Real stop)
{
    instance *own = c;
    (void)stopDefined;
    (void)stop;
    own->it.time = own->it.u_time = start;
    if (toleranceDefined) {
        if (!(tolerance > 0.0)) {
            return failed(own, fmi2Error, "the tolerance must be above 0");
        }
        /* At more than 1e-5 a step may jump over the moment at which a load leaves its stop. */
        own->it.tolerance = fmax(1e-12, fmin(1e-5, tolerance));
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2EnterInitializationMode)(fmi2Component c)
{
    instance *own = c;
    own->initialising = 1;
    plant_enter_piece(&own->it);
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2ExitInitializationMode)(fmi2Component c)
{
    instance *own = c;
    own->initialising = 0;
    own->entered = 1;
    if (own->type == fmi2CoSimulation) {
        plant_settle(prepared(own));
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2Terminate)(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2Reset)(fmi2Component c)
{
    instance *own = c;
    plant_reset(&own->it);
    own->initialising = own->entered = 0;
    return fmi2OK;
}

/* All outputs, or all rates. */
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

/* Where a value that can be set is; NULL for none. */
static double *place_of(plant *it, fmi2ValueReference reference)
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

FMI2_EXPORT fmi2Status FMI2(fmi2GetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                             fmi2Real values[])
{
    instance *own = c;
    plant *it = prepared(own);
    double out[PLANT_ROOM(MODEL_OUTPUTS)], rates[PLANT_ROOM(MODEL_STATES)], u[PLANT_ROOM(MODEL_INPUTS)];
    int have_out = 0, have_rates = 0;
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
        } else if (kind == INPUT && place != NULL) {
            plant_inputs(it, it->time, u);
            values[i] = u[number];
        } else if (place != NULL) {
            values[i] = *place;
        } else {
            return failed(own, fmi2Error, "there is no Real of this value reference");
        }
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                             const fmi2Real values[])
{
    instance *own = c;
    for (size_t i = 0; i < count; ++i) {
        double *place = place_of(&own->it, references[i]);
        const int kind = (int)(references[i] / KIND);
        if (place == NULL) {
            return failed(own, fmi2Error, "there is no Real of this value reference that can be set");
        }
        if (!isfinite(values[i])) {
            return failed(own, fmi2Error, "a value that is not finite cannot be set");
        }
        *place = values[i];
        if (kind == PARAMETER) {
            own->it.prepared = 0;
        }
        if (kind == INPUT) {
            own->it.u_rate[references[i] % KIND] = 0.0;
        }
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                fmi2Boolean values[])
{
    instance *own = c;
    for (size_t i = 0; i < count; ++i) {
        if (references[i] != PLAY) {
            return failed(own, fmi2Error, "there is no Boolean of this value reference");
        }
        values[i] = own->it.play;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                const fmi2Boolean values[])
{
    instance *own = c;
    for (size_t i = 0; i < count; ++i) {
        if (references[i] != PLAY) {
            return failed(own, fmi2Error, "there is no Boolean of this value reference");
        }
        own->it.play = values[i] != fmi2False;
    }
    return fmi2OK;
}

static fmi2Status none(fmi2Component c, size_t count, const char *message)
{
    return count == 0 ? fmi2OK : failed(c, fmi2Error, message);
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetInteger)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                fmi2Integer values[])
{
    (void)references;
    (void)values;
    return none(c, count, "the model has no Integer");
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetInteger)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                const fmi2Integer values[])
{
    (void)references;
    (void)values;
    return none(c, count, "the model has no Integer");
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetString)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                               fmi2String values[])
{
    (void)references;
    (void)values;
    return none(c, count, "the model has no String");
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetString)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                               const fmi2String values[])
{
    (void)references;
    (void)values;
    return none(c, count, "the model has no String");
}

/* A copy of everything that a run depends on. */
FMI2_EXPORT fmi2Status FMI2(fmi2GetFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    instance *own = c;
    if (*state == NULL) {
        *state = malloc(sizeof own->it);
    }
    if (*state == NULL) {
        return failed(own, fmi2Error, "there is no memory for the state");
    }
    memcpy(*state, &own->it, sizeof own->it);
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetFMUstate)(fmi2Component c, fmi2FMUstate state)
{
    memcpy(&((instance *)c)->it, state, sizeof(plant));
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2FreeFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    (void)c;
    (void)state;
    *size = sizeof(plant);
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    if (size < sizeof(plant)) {
        return failed(c, fmi2Error, "the buffer is too small for the state");
    }
    memcpy(bytes, state, sizeof(plant));
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                         fmi2FMUstate *state)
{
    if (size != sizeof(plant)) {
        return failed(c, fmi2Error, "the bytes are not a state of this FMU");
    }
    if (*state == NULL) {
        *state = malloc(sizeof(plant));
    }
    if (*state == NULL) {
        return failed(c, fmi2Error, "there is no memory for the state");
    }
    memcpy(*state, bytes, sizeof(plant));
    return fmi2OK;
}

/* Where a known of a directional derivative is, and the scale of its differences. */
static double *known_of(plant *it, fmi2ValueReference reference, double *scale)
{
    double *place = place_of(it, reference);
    *scale = place == NULL ? 0.0 : fmax(fabs(*place), 1e-3);
    if (place != NULL && reference / KIND == STATE) {
        *scale = fmax(fabs(*place), model_scales[reference % KIND]);
    }
    return place;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknowns[],
                                              size_t unknown_count, const fmi2ValueReference knowns[],
                                              size_t known_count, const fmi2Real known_changes[],
                                              fmi2Real changes[])
{
    instance *own = c;
    plant *it = prepared(own), moved = *it;
    double u[PLANT_ROOM(MODEL_INPUTS)], above[PLANT_ROOM(MODEL_OUTPUTS)], below[PLANT_ROOM(MODEL_OUTPUTS)];
    double jacobian[PLANT_ROOM(MODEL_STATES * MODEL_STATES)];
    double by_inputs[PLANT_ROOM(MODEL_STATES * MODEL_INPUTS)];
    plant_inputs(it, it->time, u);
    plant_jacobian(it->y, it->k, u, it->w, jacobian);
    plant_input_jacobian(it->y, it->k, u, it->w, by_inputs);
    for (size_t i = 0; i < unknown_count; ++i) {
        const int kind = (int)(unknowns[i] / KIND), row = (int)(unknowns[i] % KIND);
        if (!((kind == RATE && row < MODEL_STATES) || (kind == OUTPUT && row < MODEL_OUTPUTS))) {
            return failed(own, fmi2Error, "there is no derivative of this value reference");
        }
        changes[i] = 0.0;
    }
    for (size_t j = 0; j < known_count; ++j) {
        const int kind = (int)(knowns[j] / KIND), column = (int)(knowns[j] % KIND);
        double scale;
        double *place = known_of(&moved, knowns[j], &scale);
        if (place == NULL || (kind != STATE && kind != INPUT)) {
            return failed(own, fmi2Error, "there is no derivative by this value reference");
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
            double slope = kind == STATE ? jacobian[PLANT_ROOM(row * MODEL_STATES + column + 1) - 1]
                                         : by_inputs[PLANT_ROOM(row * MODEL_INPUTS + column + 1) - 1];
            if (unknowns[i] / KIND == OUTPUT) {
                slope = (above[row] - below[row]) / (2.0 * step);
            }
            changes[i] += slope * known_changes[j];
        }
    }
    return fmi2OK;
}

/* Model exchange. */

FMI2_EXPORT fmi2Status FMI2(fmi2EnterEventMode)(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2NewDiscreteStates)(fmi2Component c, fmi2EventInfo *info)
{
    plant *it = prepared(c);
    memset(info, 0, sizeof *info);
    plant_enter_piece(it);
    info->valuesOfContinuousStatesChanged = plant_settle(it) ? fmi2True : fmi2False;
    info->nextEventTime = plant_next_piece(it);
    info->nextEventTimeDefined = isfinite(info->nextEventTime) ? fmi2True : fmi2False;
    if (!info->nextEventTimeDefined) {
        info->nextEventTime = 0.0;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2EnterContinuousTimeMode)(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2CompletedIntegratorStep)(fmi2Component c, fmi2Boolean final, fmi2Boolean *event,
                                             fmi2Boolean *terminate)
{
    (void)c;
    (void)final;
    *event = *terminate = fmi2False;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetTime)(fmi2Component c, fmi2Real time)
{
    ((instance *)c)->it.time = time;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetContinuousStates)(fmi2Component c, const fmi2Real x[], size_t count)
{
    instance *own = c;
    if (count != MODEL_STATES) {
        return failed(own, fmi2Error, "wrong number of states");
    }
    for (size_t i = 0; i < count; ++i) {
        own->it.y[i] = x[i];
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetContinuousStates)(fmi2Component c, fmi2Real x[], size_t count)
{
    instance *own = c;
    if (count != MODEL_STATES) {
        return failed(own, fmi2Error, "wrong number of states");
    }
    for (size_t i = 0; i < count; ++i) {
        x[i] = own->it.y[i];
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetNominalsOfContinuousStates)(fmi2Component c, fmi2Real nominals[], size_t count)
{
    if (count != MODEL_STATES) {
        return failed(c, fmi2Error, "wrong number of states");
    }
    for (size_t i = 0; i < count; ++i) {
        nominals[i] = model_scales[i];
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetDerivatives)(fmi2Component c, fmi2Real rates[], size_t count)
{
    double all[PLANT_ROOM(MODEL_STATES)];
    if (count != MODEL_STATES) {
        return failed(c, fmi2Error, "wrong number of states");
    }
    rates_of(prepared(c), all);
    for (size_t i = 0; i < count; ++i) {
        rates[i] = all[i];
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetEventIndicators)(fmi2Component c, fmi2Real indicators[], size_t count)
{
    double guards[PLANT_ROOM(MODEL_SWITCHES)], u[PLANT_ROOM(MODEL_INPUTS)];
    plant *it = prepared(c);
    if (count != MODEL_SWITCHES) {
        return failed(c, fmi2Error, "wrong number of event indicators");
    }
    plant_inputs(it, it->time, u);
    model_guards(it->y, it->k, u, it->w, guards);
    for (size_t i = 0; i < count; ++i) {
        indicators[i] = guards[i] + MODEL_LEAST;
    }
    return fmi2OK;
}

/* Co-simulation. */

FMI2_EXPORT fmi2Status FMI2(fmi2DoStep)(fmi2Component c, fmi2Real now, fmi2Real size, fmi2Boolean no_return)
{
    static const char *const why[] = {
        "", "the step became too small", "the solution is not finite", "a switch chatters"};
    instance *own = c;
    (void)no_return;
    if (!own->entered || fabs(now - own->it.time) > 1e-9 * (1.0 + fabs(now))) {
        return failed(own, fmi2Error, "the step does not begin where the last one ended");
    }
    if (!(size >= 0.0)) {
        return failed(own, fmi2Error, "the size of a step must not be negative");
    }
    const int status = plant_advance(&own->it, now + size);
    double held[PLANT_ROOM(MODEL_INPUTS)];
    for (int i = 0; i < MODEL_INPUTS; ++i) {
        held[i] = own->it.u[i] + own->it.u_rate[i] * (own->it.time - own->it.u_time);
        own->it.u[i] = held[i];
        own->it.u_rate[i] = 0.0;
    }
    own->it.u_time = own->it.time;
    return status == PLANT_DONE ? fmi2OK : failed(own, fmi2Error, why[status]);
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference references[],
                                             size_t count, const fmi2Integer orders[], const fmi2Real values[])
{
    instance *own = c;
    for (size_t i = 0; i < count; ++i) {
        const int number = (int)(references[i] % KIND);
        if (references[i] / KIND != INPUT || number >= MODEL_INPUTS || orders[i] != 1) {
            return failed(own, fmi2Error, "only the first derivative of an input can be set");
        }
        own->it.u_rate[number] = values[i];
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference references[],
                                              size_t count, const fmi2Integer orders[], fmi2Real values[])
{
    (void)references;
    (void)orders;
    (void)values;
    return none(c, count, "derivatives of outputs are not given");
}

FMI2_EXPORT fmi2Status FMI2(fmi2CancelStep)(fmi2Component c)
{
    return failed(c, fmi2Error, "no step is running");
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind;
    (void)value;
    return failed(c, fmi2Discard, "steps are done when they return");
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    if (kind != fmi2LastSuccessfulTime) {
        return failed(c, fmi2Discard, "there is no Real status of this kind");
    }
    *value = ((instance *)c)->it.time;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetIntegerStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    (void)value;
    return failed(c, fmi2Discard, "there is no Integer status");
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    (void)kind;
    *value = fmi2False;
    return failed(c, fmi2Discard, "the model never ends a simulation");
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetStringStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind;
    (void)value;
    return failed(c, fmi2Discard, "there is no String status");
}
