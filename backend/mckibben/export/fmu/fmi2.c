/* FMI 2.0 for model exchange and co-simulation around one plant. */
#include "access.h"
#include "fmi2.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* The status of a call that returned a sentence or NULL. */
static fmi2Status told(const instance *own, const char *message)
{
    return message == NULL ? fmi2OK : failed(own, fmi2Error, message);
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
    return told(own, plant_begin(&own->it, start, toleranceDefined, tolerance));
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
        plant_settle(&own->it);
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

FMI2_EXPORT fmi2Status FMI2(fmi2GetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                             fmi2Real values[])
{
    instance *own = c;
    return told(own, plant_get(&own->it, references, count, values));
}

FMI2_EXPORT fmi2Status FMI2(fmi2SetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                             const fmi2Real values[])
{
    instance *own = c;
    return told(own, plant_set(&own->it, references, count, values));
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

FMI2_EXPORT fmi2Status FMI2(fmi2GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknowns[],
                                              size_t unknown_count, const fmi2ValueReference knowns[],
                                              size_t known_count, const fmi2Real known_changes[],
                                              fmi2Real changes[])
{
    instance *own = c;
    return told(own, plant_directional(&own->it, unknowns, unknown_count, knowns, known_count, known_changes,
                                       changes));
}

/* Model exchange. */

FMI2_EXPORT fmi2Status FMI2(fmi2EnterEventMode)(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2(fmi2NewDiscreteStates)(fmi2Component c, fmi2EventInfo *info)
{
    plant *it = &((instance *)c)->it;
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
    return told(own, plant_set_states(&own->it, x, count));
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetContinuousStates)(fmi2Component c, fmi2Real x[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_states(&own->it, x, count));
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetNominalsOfContinuousStates)(fmi2Component c, fmi2Real nominals[], size_t count)
{
    return told(c, plant_get_nominals(nominals, count));
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetDerivatives)(fmi2Component c, fmi2Real rates[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_rates(&own->it, rates, count));
}

FMI2_EXPORT fmi2Status FMI2(fmi2GetEventIndicators)(fmi2Component c, fmi2Real indicators[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_indicators(&own->it, indicators, count));
}

/* Co-simulation. */

FMI2_EXPORT fmi2Status FMI2(fmi2DoStep)(fmi2Component c, fmi2Real now, fmi2Real size, fmi2Boolean no_return)
{
    instance *own = c;
    (void)no_return;
    return own->entered ? told(own, plant_step(&own->it, now, size))
                        : failed(own, fmi2Error, "the initialisation has not ended");
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
