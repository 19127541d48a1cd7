/* FMI 2.0 or 3.0 (fmi.h says which) for model exchange and co-simulation around one plant. */
#include "access.h"
#include "fmi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    plant it;
#if FMI_VERSION == 2
    fmi2CallbackFunctions callbacks;
    char name[128];
#else
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
#endif
    int exchanges; /* whether the states are integrated by the caller */
    int entered;   /* whether the initialisation has ended */
} instance;

static fmiStatus said(const instance *own, fmiStatus status, const char *message)
{
#if FMI_VERSION == 2
    if (own->callbacks.logger != NULL) {
        own->callbacks.logger(own->callbacks.componentEnvironment, own->name, status, "logStatusError", "%s", message);
    }
#else
    if (own->log != NULL) {
        own->log(own->environment, status, "logStatusError", message);
    }
#endif
    return status;
}

static fmiStatus failed(const instance *own, const char *message)
{
    return said(own, fmiError, message);
}

/* The status of a call that returned a sentence or NULL. */
static fmiStatus told(const instance *own, const char *message)
{
    return message == NULL ? fmiOK : failed(own, message);
}

/* The status of a call for variables of a type that the model does not have. */
static fmiStatus none(const instance *own, size_t count)
{
    return count == 0 ? fmiOK : failed(own, "the model has no variable of this type");
}

static fmiStatus done(const instance *own)
{
    (void)own;
    return fmiOK;
}

/* A new instance, NULL where the binary is that of another description. */
static instance *made(instance first, const char *token)
{
    instance *own = calloc(1, sizeof *own);
    if (own == NULL) {
        return NULL;
    }
    *own = first;
    plant_reset(&own->it);
    if (strcmp(token, MODEL_GUID) != 0) {
        failed(own, "the identifier is not that of the binary: modelDescription.xml is of another FMU");
        free(own);
        return NULL;
    }
    return own;
}

/* Life. */

FMI_EXPORT const char *FMI(GetVersion)(void)
{
    return FMI_VERSION == 2 ? "2.0" : "3.0";
}

FMI_EXPORT fmiStatus FMI(SetDebugLogging)(fmiInstance c, fmiBoolean on, size_t count, const fmiString categories[])
{
    (void)on;
    (void)count;
    (void)categories;
    return done(c);
}

FMI_EXPORT void FMI(FreeInstance)(fmiInstance c)
{
    free(c);
}

FMI_EXPORT fmiStatus FMI(ExitInitializationMode)(fmiInstance c)
{
    instance *own = c;
    own->entered = 1;
    if (!own->exchanges) {
        plant_settle(&own->it);
    }
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI(Terminate)(fmiInstance c)
{
    return done(c);
}

FMI_EXPORT fmiStatus FMI(Reset)(fmiInstance c)
{
    instance *own = c;
    plant_reset(&own->it);
    own->entered = 0;
    return fmiOK;
}

/* Values; PLACES is the number of values that FMI 3.0 states beside that of the variables. */

FMI_EXPORT fmiStatus FMI_REAL(Get)(fmiInstance c, const fmiValueReference references[], size_t count,
                                   fmiReal values[] PLACES)
{
    instance *own = c;
    return told(own, TOO_FEW(count) ? "too few values" : plant_get(&own->it, references, count, values));
}

FMI_EXPORT fmiStatus FMI_REAL(Set)(fmiInstance c, const fmiValueReference references[], size_t count,
                                   const fmiReal values[] PLACES)
{
    instance *own = c;
    return told(own, TOO_FEW(count) ? "too few values" : plant_set(&own->it, references, count, values));
}

/* Whether all are the only Boolean. */
static const char *not_play(const fmiValueReference references[], size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        if (references[i] != PLAY) {
            return "there is no Boolean of this value reference";
        }
    }
    return NULL;
}

FMI_EXPORT fmiStatus FMI(GetBoolean)(fmiInstance c, const fmiValueReference references[], size_t count,
                                     fmiBoolean values[] PLACES)
{
    instance *own = c;
    const char *message = TOO_FEW(count) ? "too few values" : not_play(references, count);
    for (size_t i = 0; message == NULL && i < count; ++i) {
        values[i] = own->it.play != 0;
    }
    return told(own, message);
}

FMI_EXPORT fmiStatus FMI(SetBoolean)(fmiInstance c, const fmiValueReference references[], size_t count,
                                     const fmiBoolean values[] PLACES)
{
    instance *own = c;
    const char *message = TOO_FEW(count) ? "too few values" : not_play(references, count);
    for (size_t i = 0; message == NULL && i < count; ++i) {
        own->it.play = values[i] != 0;
    }
    return told(own, message);
}

/* Types of which there is no variable. */
#define NO_VARIABLES(type)                                                                                    \
    FMI_EXPORT fmiStatus FMI(Get##type)(fmiInstance c, const fmiValueReference references[], size_t count,    \
                                        FMI_TYPE(type) values[] PLACES)                                       \
    {                                                                                                         \
        (void)references;                                                                                     \
        (void)values;                                                                                         \
        UNUSED_PLACES;                                                                                        \
        return none(c, count);                                                                                \
    }                                                                                                         \
    FMI_EXPORT fmiStatus FMI(Set##type)(fmiInstance c, const fmiValueReference references[], size_t count,    \
                                        const FMI_TYPE(type) values[] PLACES)                                 \
    {                                                                                                         \
        (void)references;                                                                                     \
        (void)values;                                                                                         \
        UNUSED_PLACES;                                                                                        \
        return none(c, count);                                                                                \
    }

NO_VARIABLES(String)
#if FMI_VERSION == 2
NO_VARIABLES(Integer)
#else
NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(Int32)
NO_VARIABLES(UInt32)
NO_VARIABLES(Int64)
NO_VARIABLES(UInt64)
#endif

/* A copy of everything that a run depends on. */

static fmiStatus copied(const instance *own, const void *from, fmiState *state)
{
    if (*state == NULL) {
        *state = malloc(sizeof(plant));
    }
    if (*state == NULL) {
        return failed(own, "there is no memory for the state");
    }
    memcpy(*state, from, sizeof(plant));
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI_STATE(Get)(fmiInstance c, fmiState *state)
{
    return copied(c, &((instance *)c)->it, state);
}

FMI_EXPORT fmiStatus FMI_STATE(Set)(fmiInstance c, fmiState state)
{
    memcpy(&((instance *)c)->it, state, sizeof(plant));
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI_STATE(Free)(fmiInstance c, fmiState *state)
{
    free(*state);
    *state = NULL;
    return done(c);
}

FMI_EXPORT fmiStatus FMI_STATE_SIZE(fmiInstance c, fmiState state, size_t *size)
{
    (void)state;
    *size = sizeof(plant);
    return done(c);
}

FMI_EXPORT fmiStatus FMI_STATE(Serialize)(fmiInstance c, fmiState state, fmiByte bytes[], size_t size)
{
    if (size < sizeof(plant)) {
        return failed(c, "the buffer is too small for the state");
    }
    memcpy(bytes, state, sizeof(plant));
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI_STATE(FMI_DESERIALIZE)(fmiInstance c, const fmiByte bytes[], size_t size, fmiState *state)
{
    return size == sizeof(plant) ? copied(c, bytes, state) : failed(c, "the bytes are not a state of this FMU");
}

/* Model exchange. */

FMI_EXPORT fmiStatus FMI(EnterEventMode)(fmiInstance c)
{
    return done(c);
}

/* The piece of the inputs that begins now, and the switches that change; whether any does. */
static int next_event(plant *it, double *next, int *defined)
{
    plant_enter_piece(it);
    const int changed = plant_settle(it) != 0;
    *next = plant_next_piece(it);
    *defined = isfinite(*next) != 0;
    if (!*defined) {
        *next = 0.0;
    }
    return changed;
}

FMI_EXPORT fmiStatus FMI(EnterContinuousTimeMode)(fmiInstance c)
{
    return done(c);
}

FMI_EXPORT fmiStatus FMI(CompletedIntegratorStep)(fmiInstance c, fmiBoolean final, fmiBoolean *event,
                                                  fmiBoolean *terminate)
{
    (void)final;
    *event = *terminate = 0;
    return done(c);
}

FMI_EXPORT fmiStatus FMI(SetTime)(fmiInstance c, fmiReal time)
{
    ((instance *)c)->it.time = time;
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI(SetContinuousStates)(fmiInstance c, const fmiReal states[], size_t count)
{
    instance *own = c;
    return told(own, plant_set_states(&own->it, states, count));
}

FMI_EXPORT fmiStatus FMI(GetContinuousStates)(fmiInstance c, fmiReal states[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_states(&own->it, states, count));
}

FMI_EXPORT fmiStatus FMI_RATES(fmiInstance c, fmiReal rates[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_rates(&own->it, rates, count));
}

FMI_EXPORT fmiStatus FMI(GetNominalsOfContinuousStates)(fmiInstance c, fmiReal nominals[], size_t count)
{
    return told(c, plant_get_nominals(nominals, count));
}

FMI_EXPORT fmiStatus FMI(GetEventIndicators)(fmiInstance c, fmiReal indicators[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_indicators(&own->it, indicators, count));
}

/* Co-simulation. */

static const char *stepped(instance *own, double now, double size)
{
    return own->entered ? plant_step(&own->it, now, size) : "the initialisation has not ended";
}

static const char no_output_derivatives[] = "derivatives of outputs are not given";

#if FMI_VERSION == 2

/* What FMI 2.0 has in another form, or alone. */

FMI_EXPORT const char *FMI(GetTypesPlatform)(void)
{
    return "default";
}

FMI_EXPORT fmiInstance FMI(Instantiate)(fmiString name, fmi2Type type, fmiString guid, fmiString resources,
                                        const fmi2CallbackFunctions *callbacks, fmiBoolean visible,
                                        fmiBoolean logging)
{
    (void)resources;
    (void)visible;
    (void)logging;
    if (name == NULL || guid == NULL || callbacks == NULL) {
        return NULL;
    }
    instance first = {.callbacks = *callbacks, .exchanges = type == fmi2ModelExchange};
    strncpy(first.name, name, sizeof first.name - 1);
    return made(first, guid);
}

FMI_EXPORT fmiStatus FMI(SetupExperiment)(fmiInstance c, fmiBoolean stated, fmiReal tolerance, fmiReal start,
                                          fmiBoolean ends, fmiReal stop)
{
    instance *own = c;
    (void)ends;
    (void)stop;
    return told(own, plant_begin(&own->it, start, stated, tolerance));
}

FMI_EXPORT fmiStatus FMI(EnterInitializationMode)(fmiInstance c)
{
    plant_enter_piece(&((instance *)c)->it);
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI(GetDirectionalDerivative)(fmiInstance c, const fmiValueReference unknowns[],
                                                   size_t unknown_count, const fmiValueReference knowns[],
                                                   size_t known_count, const fmiReal seed[], fmiReal sensitivity[])
{
    instance *own = c;
    return told(own, plant_directional(&own->it, unknowns, unknown_count, knowns, known_count, seed, sensitivity));
}

FMI_EXPORT fmiStatus FMI(NewDiscreteStates)(fmiInstance c, fmi2EventInfo *info)
{
    memset(info, 0, sizeof *info);
    info->valuesOfContinuousStatesChanged =
        next_event(&((instance *)c)->it, &info->nextEventTime, &info->nextEventTimeDefined);
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI(DoStep)(fmiInstance c, fmiReal now, fmiReal size, fmiBoolean no_return)
{
    (void)no_return;
    return told(c, stepped(c, now, size));
}

FMI_EXPORT fmiStatus FMI(SetRealInputDerivatives)(fmiInstance c, const fmiValueReference references[], size_t count,
                                                  const fmi2Integer orders[], const fmiReal values[])
{
    instance *own = c;
    for (size_t i = 0; i < count; ++i) {
        const int number = (int)(references[i] % KIND);
        if (references[i] / KIND != INPUT || number >= MODEL_INPUTS || orders[i] != 1) {
            return failed(own, "only the first derivative of an input can be set");
        }
        own->it.u_rate[number] = values[i];
    }
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI(GetRealOutputDerivatives)(fmiInstance c, const fmiValueReference references[], size_t count,
                                                   const fmi2Integer orders[], fmiReal values[])
{
    (void)references;
    (void)orders;
    (void)values;
    return count == 0 ? fmiOK : failed(c, no_output_derivatives);
}

FMI_EXPORT fmiStatus FMI(CancelStep)(fmiInstance c)
{
    return failed(c, "no step is running");
}

FMI_EXPORT fmiStatus FMI(GetRealStatus)(fmiInstance c, const fmi2StatusKind kind, fmiReal *value)
{
    if (kind != fmi2LastSuccessfulTime) {
        return said(c, fmi2Discard, "there is no Real status of this kind");
    }
    *value = ((instance *)c)->it.time;
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI(GetBooleanStatus)(fmiInstance c, const fmi2StatusKind kind, fmiBoolean *value)
{
    (void)kind;
    *value = fmi2False;
    return said(c, fmi2Discard, "the model never ends a simulation");
}

#define NO_STATUS(what, type)                                                                                 \
    FMI_EXPORT fmiStatus FMI(Get##what##Status)(fmiInstance c, const fmi2StatusKind kind, type *value)        \
    {                                                                                                         \
        (void)kind;                                                                                           \
        (void)value;                                                                                          \
        return said(c, fmi2Discard, "steps are done when they return: there is no status of this type");     \
    }

NO_STATUS(, fmi2Status)
NO_STATUS(Integer, fmi2Integer)
NO_STATUS(String, fmi2String)

#else

/* What FMI 3.0 has in another form, or alone. */

FMI_EXPORT fmiInstance FMI(InstantiateModelExchange)(fmiString name, fmiString token, fmiString resources,
                                                     fmiBoolean visible, fmiBoolean logging,
                                                     fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    (void)resources;
    (void)visible;
    (void)logging;
    const instance first = {.environment = environment, .log = log, .exchanges = 1};
    return name == NULL || token == NULL ? NULL : made(first, token);
}

FMI_EXPORT fmiInstance FMI(InstantiateCoSimulation)(fmiString name, fmiString token, fmiString resources,
                                                    fmiBoolean visible, fmiBoolean logging, fmiBoolean events,
                                                    fmiBoolean early, const fmiValueReference intermediate[],
                                                    size_t intermediates, fmi3InstanceEnvironment environment,
                                                    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    (void)resources;
    (void)visible;
    (void)logging;
    (void)events;
    (void)early;
    (void)intermediate;
    (void)intermediates;
    (void)update;
    const instance first = {.environment = environment, .log = log};
    return name == NULL || token == NULL ? NULL : made(first, token);
}

FMI_EXPORT fmiInstance FMI(InstantiateScheduledExecution)(fmiString name, fmiString token, fmiString resources,
                                                          fmiBoolean visible, fmiBoolean logging,
                                                          fmi3InstanceEnvironment environment,
                                                          fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
                                                          fmi3LockPreemptionCallback lock,
                                                          fmi3UnlockPreemptionCallback unlock)
{
    (void)name;
    (void)token;
    (void)resources;
    (void)visible;
    (void)logging;
    (void)environment;
    (void)log;
    (void)update;
    (void)lock;
    (void)unlock;
    return NULL;
}

FMI_EXPORT fmiStatus FMI(EnterInitializationMode)(fmiInstance c, fmiBoolean stated, fmiReal tolerance, fmiReal start,
                                                  fmiBoolean ends, fmiReal stop)
{
    instance *own = c;
    (void)ends;
    (void)stop;
    const char *message = plant_begin(&own->it, start, stated, tolerance);
    plant_enter_piece(&own->it);
    return told(own, message);
}

FMI_EXPORT fmiStatus FMI(GetDirectionalDerivative)(fmiInstance c, const fmiValueReference unknowns[],
                                                   size_t unknown_count, const fmiValueReference knowns[],
                                                   size_t known_count, const fmiReal seed[], size_t seeds,
                                                   fmiReal sensitivity[], size_t sensitivities)
{
    instance *own = c;
    if (seeds != known_count || sensitivities != unknown_count) {
        return failed(own, "a change for each known and each unknown is needed");
    }
    return told(own, plant_directional(&own->it, unknowns, unknown_count, knowns, known_count, seed, sensitivity));
}

FMI_EXPORT fmiStatus FMI(EvaluateDiscreteStates)(fmiInstance c)
{
    return done(c);
}

FMI_EXPORT fmiStatus FMI(UpdateDiscreteStates)(fmiInstance c, fmiBoolean *again, fmiBoolean *terminate,
                                               fmiBoolean *nominals, fmiBoolean *states, fmiBoolean *defined,
                                               fmiReal *next)
{
    int is_defined;
    *again = *terminate = *nominals = fmi3False;
    *states = next_event(&((instance *)c)->it, next, &is_defined) != 0;
    *defined = is_defined != 0;
    return fmiOK;
}

FMI_EXPORT fmiStatus FMI(GetNumberOfEventIndicators)(fmiInstance c, size_t *count)
{
    *count = MODEL_SWITCHES;
    return done(c);
}

FMI_EXPORT fmiStatus FMI(GetNumberOfContinuousStates)(fmiInstance c, size_t *count)
{
    *count = MODEL_STATES;
    return done(c);
}

FMI_EXPORT fmiStatus FMI(EnterStepMode)(fmiInstance c)
{
    return done(c);
}

FMI_EXPORT fmiStatus FMI(DoStep)(fmiInstance c, fmiReal now, fmiReal size, fmiBoolean final, fmiBoolean *event,
                                 fmiBoolean *terminate, fmiBoolean *early, fmiReal *last)
{
    instance *own = c;
    (void)final;
    *event = *terminate = *early = fmi3False;
    const char *message = stepped(own, now, size);
    *last = own->it.time;
    return told(own, message);
}

FMI_EXPORT fmiStatus FMI(GetOutputDerivatives)(fmiInstance c, const fmiValueReference references[], size_t count,
                                               const fmi3Int32 orders[], fmiReal values[], size_t places)
{
    (void)references;
    (void)orders;
    (void)values;
    (void)places;
    return count == 0 ? fmiOK : failed(c, no_output_derivatives);
}

/* Binaries and clocks, of which there are none, each with its own arguments after the number of variables. */
#define NONE_OF(name, ...)                                                                                    \
    FMI_EXPORT fmiStatus FMI(name)(fmiInstance c, const fmiValueReference references[], size_t count,         \
                                   __VA_ARGS__)

NONE_OF(GetBinary, size_t sizes[], fmi3Binary values[], size_t places)
{
    (void)references, (void)sizes, (void)values, (void)places;
    return none(c, count);
}

NONE_OF(SetBinary, const size_t sizes[], const fmi3Binary values[], size_t places)
{
    (void)references, (void)sizes, (void)values, (void)places;
    return none(c, count);
}

NONE_OF(GetClock, fmi3Clock values[])
{
    (void)references, (void)values;
    return none(c, count);
}

NONE_OF(SetClock, const fmi3Clock values[])
{
    (void)references, (void)values;
    return none(c, count);
}

NONE_OF(GetIntervalDecimal, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)intervals, (void)qualifiers;
    return none(c, count);
}

NONE_OF(GetIntervalFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)counters, (void)resolutions, (void)qualifiers;
    return none(c, count);
}

NONE_OF(GetShiftDecimal, fmi3Float64 shifts[])
{
    (void)references, (void)shifts;
    return none(c, count);
}

NONE_OF(GetShiftFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)references, (void)counters, (void)resolutions;
    return none(c, count);
}

NONE_OF(SetIntervalDecimal, const fmi3Float64 intervals[])
{
    (void)references, (void)intervals;
    return none(c, count);
}

NONE_OF(SetIntervalFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)references, (void)counters, (void)resolutions;
    return none(c, count);
}

NONE_OF(SetShiftDecimal, const fmi3Float64 shifts[])
{
    (void)references, (void)shifts;
    return none(c, count);
}

NONE_OF(SetShiftFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)references, (void)counters, (void)resolutions;
    return none(c, count);
}

FMI_EXPORT fmiStatus FMI(ActivateModelPartition)(fmiInstance c, fmiValueReference clock, fmiReal time)
{
    (void)clock;
    (void)time;
    return none(c, 1);
}

/* What modelDescription.xml says is not provided. */

static const char elsewhere[] = "dependencies are those of modelDescription.xml";
static const char unstructured[] = "the model has no structural parameter";

FMI_EXPORT fmiStatus FMI(GetNumberOfVariableDependencies)(fmiInstance c, fmiValueReference reference, size_t *count)
{
    (void)reference;
    *count = 0;
    return failed(c, elsewhere);
}

FMI_EXPORT fmiStatus FMI(GetVariableDependencies)(fmiInstance c, fmiValueReference dependent, size_t elements[],
                                                  fmiValueReference independents[], size_t of_independents[],
                                                  fmi3DependencyKind kinds[], size_t count)
{
    (void)dependent;
    (void)elements;
    (void)independents;
    (void)of_independents;
    (void)kinds;
    (void)count;
    return failed(c, elsewhere);
}

FMI_EXPORT fmiStatus FMI(GetAdjointDerivative)(fmiInstance c, const fmiValueReference unknowns[],
                                               size_t unknown_count, const fmiValueReference knowns[],
                                               size_t known_count, const fmiReal seed[], size_t seeds,
                                               fmiReal sensitivity[], size_t sensitivities)
{
    (void)unknowns;
    (void)unknown_count;
    (void)knowns;
    (void)known_count;
    (void)seed;
    (void)seeds;
    (void)sensitivity;
    (void)sensitivities;
    return failed(c, "derivatives are directional ones only");
}

FMI_EXPORT fmiStatus FMI(EnterConfigurationMode)(fmiInstance c)
{
    return failed(c, unstructured);
}

FMI_EXPORT fmiStatus FMI(ExitConfigurationMode)(fmiInstance c)
{
    return failed(c, unstructured);
}

#endif
