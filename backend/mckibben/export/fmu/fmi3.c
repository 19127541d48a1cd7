/* FMI 3.0 for model exchange and co-simulation around one plant. */
#include "access.h"
#include "fmi3.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    plant it;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    int exchanges; /* whether the states are integrated by the caller */
    int entered;
} instance;

static fmi3Status failed(const instance *own, const char *message)
{
    if (own->log != NULL) {
        own->log(own->environment, fmi3Error, "logStatusError", message);
    }
    return fmi3Error;
}

/* The status of a call that returned a sentence or NULL. */
static fmi3Status told(const instance *own, const char *message)
{
    return message == NULL ? fmi3OK : failed(own, message);
}

FMI3_EXPORT const char *FMI3(fmi3GetVersion)(void)
{
    return "3.0";
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetDebugLogging)(fmi3Instance c, fmi3Boolean on, size_t count,
                                                 const fmi3String categories[])
{
    (void)c;
    (void)on;
    (void)count;
    (void)categories;
    return fmi3OK;
}

static instance *made(fmi3String name, fmi3String token, fmi3InstanceEnvironment environment,
                      fmi3LogMessageCallback log, int exchanges)
{
    if (name == NULL || token == NULL) {
        return NULL;
    }
    instance *own = calloc(1, sizeof *own);
    if (own == NULL) {
        return NULL;
    }
    own->environment = environment;
    own->log = log;
    own->exchanges = exchanges;
    plant_reset(&own->it);
    if (strcmp(token, MODEL_GUID) != 0) {
        failed(own, "the token is not that of the binary: modelDescription.xml is of another FMU");
        free(own);
        return NULL;
    }
    return own;
}

FMI3_EXPORT fmi3Instance FMI3(fmi3InstantiateModelExchange)(fmi3String name, fmi3String token,
                                                            fmi3String resources, fmi3Boolean visible,
                                                            fmi3Boolean logging,
                                                            fmi3InstanceEnvironment environment,
                                                            fmi3LogMessageCallback log)
{
    (void)resources;
    (void)visible;
    (void)logging;
    return made(name, token, environment, log, 1);
}

FMI3_EXPORT fmi3Instance FMI3(fmi3InstantiateCoSimulation)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean events, fmi3Boolean early, const fmi3ValueReference intermediate[], size_t intermediates,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    (void)resources;
    (void)visible;
    (void)logging;
    (void)events;
    (void)early;
    (void)intermediate;
    (void)intermediates;
    (void)update;
    return made(name, token, environment, log, 0);
}

FMI3_EXPORT fmi3Instance FMI3(fmi3InstantiateScheduledExecution)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
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

FMI3_EXPORT void FMI3(fmi3FreeInstance)(fmi3Instance c)
{
    free(c);
}

FMI3_EXPORT fmi3Status FMI3(fmi3EnterInitializationMode)(fmi3Instance c, fmi3Boolean stated,
                                                         fmi3Float64 tolerance, fmi3Float64 start,
                                                         fmi3Boolean ends, fmi3Float64 stop)
{
    instance *own = c;
    (void)ends;
    (void)stop;
    const char *message = plant_begin(&own->it, start, stated, tolerance);
    plant_enter_piece(&own->it);
    return told(own, message);
}

FMI3_EXPORT fmi3Status FMI3(fmi3ExitInitializationMode)(fmi3Instance c)
{
    instance *own = c;
    own->entered = 1;
    if (!own->exchanges) {
        plant_settle(&own->it);
    }
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3Terminate)(fmi3Instance c)
{
    (void)c;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3Reset)(fmi3Instance c)
{
    instance *own = c;
    plant_reset(&own->it);
    own->entered = 0;
    return fmi3OK;
}

/* Values. */

FMI3_EXPORT fmi3Status FMI3(fmi3GetFloat64)(fmi3Instance c, const fmi3ValueReference references[],
                                            size_t count, fmi3Float64 values[], size_t places)
{
    instance *own = c;
    return told(own, places < count ? "too few values" : plant_get(&own->it, references, count, values));
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetFloat64)(fmi3Instance c, const fmi3ValueReference references[],
                                            size_t count, const fmi3Float64 values[], size_t places)
{
    instance *own = c;
    return told(own, places < count ? "too few values" : plant_set(&own->it, references, count, values));
}

/* Whether all are the only Boolean. */
static const char *not_play(const fmi3ValueReference references[], size_t count, size_t places)
{
    for (size_t i = 0; i < count; ++i) {
        if (references[i] != PLAY) {
            return "there is no Boolean of this value reference";
        }
    }
    return places < count ? "too few values" : NULL;
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetBoolean)(fmi3Instance c, const fmi3ValueReference references[],
                                            size_t count, fmi3Boolean values[], size_t places)
{
    instance *own = c;
    const char *message = not_play(references, count, places);
    for (size_t i = 0; message == NULL && i < count; ++i) {
        values[i] = own->it.play != 0;
    }
    return told(own, message);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetBoolean)(fmi3Instance c, const fmi3ValueReference references[],
                                            size_t count, const fmi3Boolean values[], size_t places)
{
    instance *own = c;
    const char *message = not_play(references, count, places);
    for (size_t i = 0; message == NULL && i < count; ++i) {
        own->it.play = values[i];
    }
    return told(own, message);
}

static fmi3Status none(const instance *own, size_t count)
{
    return count == 0 ? fmi3OK : failed(own, "the model has no variable of this type");
}

/* Types of which there is no variable. */
#define NO_VARIABLES(type)                                                                                    \
    FMI3_EXPORT fmi3Status FMI3(fmi3Get##type)(fmi3Instance c, const fmi3ValueReference references[],         \
                                               size_t count, fmi3##type values[], size_t places)              \
    {                                                                                                         \
        (void)references;                                                                                     \
        (void)values;                                                                                         \
        (void)places;                                                                                         \
        return none(c, count);                                                                                \
    }                                                                                                         \
    FMI3_EXPORT fmi3Status FMI3(fmi3Set##type)(fmi3Instance c, const fmi3ValueReference references[],         \
                                               size_t count, const fmi3##type values[], size_t places)        \
    {                                                                                                         \
        (void)references;                                                                                     \
        (void)values;                                                                                         \
        (void)places;                                                                                         \
        return none(c, count);                                                                                \
    }

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(Int32)
NO_VARIABLES(UInt32)
NO_VARIABLES(Int64)
NO_VARIABLES(UInt64)
NO_VARIABLES(String)

FMI3_EXPORT fmi3Status FMI3(fmi3GetBinary)(fmi3Instance c, const fmi3ValueReference references[],
                                           size_t count, size_t sizes[], fmi3Binary values[], size_t places)
{
    (void)references;
    (void)sizes;
    (void)values;
    (void)places;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetBinary)(fmi3Instance c, const fmi3ValueReference references[],
                                           size_t count, const size_t sizes[], const fmi3Binary values[],
                                           size_t places)
{
    (void)references;
    (void)sizes;
    (void)values;
    (void)places;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetClock)(fmi3Instance c, const fmi3ValueReference references[],
                                          size_t count, fmi3Clock values[])
{
    (void)references;
    (void)values;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetClock)(fmi3Instance c, const fmi3ValueReference references[],
                                          size_t count, const fmi3Clock values[])
{
    (void)references;
    (void)values;
    return none(c, count);
}

/* Clocks, of which there are none. */

FMI3_EXPORT fmi3Status FMI3(fmi3GetIntervalDecimal)(fmi3Instance c, const fmi3ValueReference references[],
                                                    size_t count, fmi3Float64 intervals[],
                                                    fmi3IntervalQualifier qualifiers[])
{
    (void)references;
    (void)intervals;
    (void)qualifiers;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetIntervalFraction)(fmi3Instance c, const fmi3ValueReference references[],
                                                     size_t count, fmi3UInt64 counters[],
                                                     fmi3UInt64 resolutions[],
                                                     fmi3IntervalQualifier qualifiers[])
{
    (void)references;
    (void)counters;
    (void)resolutions;
    (void)qualifiers;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetShiftDecimal)(fmi3Instance c, const fmi3ValueReference references[],
                                                 size_t count, fmi3Float64 shifts[])
{
    (void)references;
    (void)shifts;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetShiftFraction)(fmi3Instance c, const fmi3ValueReference references[],
                                                  size_t count, fmi3UInt64 counters[],
                                                  fmi3UInt64 resolutions[])
{
    (void)references;
    (void)counters;
    (void)resolutions;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetIntervalDecimal)(fmi3Instance c, const fmi3ValueReference references[],
                                                    size_t count, const fmi3Float64 intervals[])
{
    (void)references;
    (void)intervals;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetIntervalFraction)(fmi3Instance c, const fmi3ValueReference references[],
                                                     size_t count, const fmi3UInt64 counters[],
                                                     const fmi3UInt64 resolutions[])
{
    (void)references;
    (void)counters;
    (void)resolutions;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetShiftDecimal)(fmi3Instance c, const fmi3ValueReference references[],
                                                 size_t count, const fmi3Float64 shifts[])
{
    (void)references;
    (void)shifts;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetShiftFraction)(fmi3Instance c, const fmi3ValueReference references[],
                                                  size_t count, const fmi3UInt64 counters[],
                                                  const fmi3UInt64 resolutions[])
{
    (void)references;
    (void)counters;
    (void)resolutions;
    return none(c, count);
}

FMI3_EXPORT fmi3Status FMI3(fmi3ActivateModelPartition)(fmi3Instance c, fmi3ValueReference clock,
                                                        fmi3Float64 time)
{
    (void)clock;
    (void)time;
    return none(c, 1);
}

/* What modelDescription.xml says is not provided. */

FMI3_EXPORT fmi3Status FMI3(fmi3GetNumberOfVariableDependencies)(fmi3Instance c, fmi3ValueReference reference,
                                                                 size_t *count)
{
    (void)reference;
    *count = 0;
    return failed(c, "dependencies are those of modelDescription.xml");
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetVariableDependencies)(fmi3Instance c, fmi3ValueReference dependent,
                                                         size_t elements[], fmi3ValueReference independents[],
                                                         size_t of_independents[],
                                                         fmi3DependencyKind kinds[], size_t count)
{
    (void)dependent;
    (void)elements;
    (void)independents;
    (void)of_independents;
    (void)kinds;
    (void)count;
    return failed(c, "dependencies are those of modelDescription.xml");
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetAdjointDerivative)(fmi3Instance c, const fmi3ValueReference unknowns[],
                                                      size_t unknown_count, const fmi3ValueReference knowns[],
                                                      size_t known_count, const fmi3Float64 seed[],
                                                      size_t seeds, fmi3Float64 sensitivity[],
                                                      size_t sensitivities)
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

FMI3_EXPORT fmi3Status FMI3(fmi3EnterConfigurationMode)(fmi3Instance c)
{
    return failed(c, "the model has no structural parameter");
}

FMI3_EXPORT fmi3Status FMI3(fmi3ExitConfigurationMode)(fmi3Instance c)
{
    return failed(c, "the model has no structural parameter");
}

/* A copy of everything that a run depends on. */

static fmi3Status copied(const instance *own, const void *from, fmi3FMUState *state)
{
    if (*state == NULL) {
        *state = malloc(sizeof(plant));
    }
    if (*state == NULL) {
        return failed(own, "there is no memory for the state");
    }
    memcpy(*state, from, sizeof(plant));
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    return copied(c, &((instance *)c)->it, state);
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetFMUState)(fmi3Instance c, fmi3FMUState state)
{
    memcpy(&((instance *)c)->it, state, sizeof(plant));
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3FreeFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    (void)c;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3SerializedFMUStateSize)(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    (void)c;
    (void)state;
    *size = sizeof(plant);
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3SerializeFMUState)(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[],
                                                   size_t size)
{
    if (size < sizeof(plant)) {
        return failed(c, "the buffer is too small for the state");
    }
    memcpy(bytes, state, sizeof(plant));
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3DeserializeFMUState)(fmi3Instance c, const fmi3Byte bytes[], size_t size,
                                                     fmi3FMUState *state)
{
    return size == sizeof(plant) ? copied(c, bytes, state)
                                 : failed(c, "the bytes are not a state of this FMU");
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetDirectionalDerivative)(fmi3Instance c, const fmi3ValueReference unknowns[],
                                                          size_t unknown_count,
                                                          const fmi3ValueReference knowns[],
                                                          size_t known_count, const fmi3Float64 seed[],
                                                          size_t seeds, fmi3Float64 sensitivity[],
                                                          size_t sensitivities)
{
    instance *own = c;
    if (seeds != known_count || sensitivities != unknown_count) {
        return failed(own, "a change for each known and each unknown is needed");
    }
    return told(own, plant_directional(&own->it, unknowns, unknown_count, knowns, known_count, seed,
                                       sensitivity));
}

/* Model exchange. */

FMI3_EXPORT fmi3Status FMI3(fmi3EnterEventMode)(fmi3Instance c)
{
    (void)c;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3EvaluateDiscreteStates)(fmi3Instance c)
{
    (void)c;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3UpdateDiscreteStates)(fmi3Instance c, fmi3Boolean *again,
                                                      fmi3Boolean *terminate, fmi3Boolean *nominals,
                                                      fmi3Boolean *states, fmi3Boolean *defined,
                                                      fmi3Float64 *next)
{
    plant *it = &((instance *)c)->it;
    *again = *terminate = *nominals = fmi3False;
    plant_enter_piece(it);
    *states = plant_settle(it) != 0;
    *next = plant_next_piece(it);
    *defined = isfinite(*next) != 0;
    if (!*defined) {
        *next = 0.0;
    }
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3EnterContinuousTimeMode)(fmi3Instance c)
{
    (void)c;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3CompletedIntegratorStep)(fmi3Instance c, fmi3Boolean final, fmi3Boolean *event,
                                                         fmi3Boolean *terminate)
{
    (void)c;
    (void)final;
    *event = *terminate = fmi3False;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetTime)(fmi3Instance c, fmi3Float64 time)
{
    ((instance *)c)->it.time = time;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3SetContinuousStates)(fmi3Instance c, const fmi3Float64 states[], size_t count)
{
    instance *own = c;
    return told(own, plant_set_states(&own->it, states, count));
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetContinuousStates)(fmi3Instance c, fmi3Float64 states[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_states(&own->it, states, count));
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetContinuousStateDerivatives)(fmi3Instance c, fmi3Float64 rates[],
                                                               size_t count)
{
    instance *own = c;
    return told(own, plant_get_rates(&own->it, rates, count));
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetNominalsOfContinuousStates)(fmi3Instance c, fmi3Float64 nominals[],
                                                               size_t count)
{
    return told(c, plant_get_nominals(nominals, count));
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetEventIndicators)(fmi3Instance c, fmi3Float64 indicators[], size_t count)
{
    instance *own = c;
    return told(own, plant_get_indicators(&own->it, indicators, count));
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetNumberOfEventIndicators)(fmi3Instance c, size_t *count)
{
    (void)c;
    *count = MODEL_SWITCHES;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetNumberOfContinuousStates)(fmi3Instance c, size_t *count)
{
    (void)c;
    *count = MODEL_STATES;
    return fmi3OK;
}

/* Co-simulation. */

FMI3_EXPORT fmi3Status FMI3(fmi3EnterStepMode)(fmi3Instance c)
{
    (void)c;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3(fmi3GetOutputDerivatives)(fmi3Instance c, const fmi3ValueReference references[],
                                                      size_t count, const fmi3Int32 orders[],
                                                      fmi3Float64 values[], size_t places)
{
    (void)references;
    (void)orders;
    (void)values;
    (void)places;
    return count == 0 ? fmi3OK : failed(c, "derivatives of outputs are not given");
}

FMI3_EXPORT fmi3Status FMI3(fmi3DoStep)(fmi3Instance c, fmi3Float64 now, fmi3Float64 size,
                                        fmi3Boolean final, fmi3Boolean *event, fmi3Boolean *terminate,
                                        fmi3Boolean *early, fmi3Float64 *last)
{
    instance *own = c;
    (void)final;
    *event = *terminate = *early = fmi3False;
    const char *message = own->entered ? plant_step(&own->it, now, size) : "the initialisation has not ended";
    *last = own->it.time;
    return told(own, message);
}
