/* A small importer: co-simulation in steps of a millisecond, then every other kind of call once.
 * Writes the position after each step as doubles. Arguments: GUID, steps. */
#include "access.h"
#include "fmi.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if FMI_VERSION == 2
#define OK fmi2OK
typedef fmi2Component component;
fmi2Component fmi2Instantiate(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *,
                              fmi2Boolean, fmi2Boolean);
void fmi2FreeInstance(fmi2Component);
fmi2Status fmi2SetupExperiment(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
fmi2Status fmi2EnterInitializationMode(fmi2Component);
fmi2Status fmi2ExitInitializationMode(fmi2Component);
fmi2Status fmi2SetBoolean(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[]);
fmi2Status fmi2GetReal(fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]);
fmi2Status fmi2SetReal(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]);
fmi2Status fmi2DoStep(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
fmi2Status fmi2GetFMUstate(fmi2Component, fmi2FMUstate *);
fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate *);
fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate *);
fmi2Status fmi2SetFMUstate(fmi2Component, fmi2FMUstate);
fmi2Status fmi2GetDerivatives(fmi2Component, fmi2Real[], size_t);
fmi2Status fmi2GetContinuousStates(fmi2Component, fmi2Real[], size_t);
fmi2Status fmi2SetContinuousStates(fmi2Component, const fmi2Real[], size_t);
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component, fmi2Real[], size_t);
fmi2Status fmi2GetEventIndicators(fmi2Component, fmi2Real[], size_t);
fmi2Status fmi2NewDiscreteStates(fmi2Component, fmi2EventInfo *);
fmi2Status fmi2GetDirectionalDerivative(fmi2Component, const fmi2ValueReference[], size_t,
                                        const fmi2ValueReference[], size_t, const fmi2Real[], fmi2Real[]);
fmi2Status fmi2Reset(fmi2Component);
fmi2Status fmi2Terminate(fmi2Component);

static component begun(const char *guid)
{
    static const fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    return fmi2Instantiate("host", fmi2CoSimulation, guid, "", &callbacks, 0, 0);
}
static int initialised(component c)
{
    const fmi2ValueReference play = PLAY;
    const fmi2Boolean on = fmi2True;
    return fmi2SetupExperiment(c, 1, 1e-7, 0.0, 0, 0.0) == OK && fmi2EnterInitializationMode(c) == OK &&
           fmi2SetBoolean(c, &play, 1, &on) == OK && fmi2ExitInitializationMode(c) == OK;
}
static int stepped(component c, double now, double size)
{
    return fmi2DoStep(c, now, size, 1) == OK;
}
static int updated(component c)
{
    fmi2EventInfo info;
    return fmi2NewDiscreteStates(c, &info) == OK;
}
static int directional(component c, const unsigned *unknowns, size_t rows, const unsigned *knowns,
                       size_t columns, const double *seed, double *found)
{
    return fmi2GetDirectionalDerivative(c, unknowns, rows, knowns, columns, seed, found) == OK;
}
#define GET(c, references, count, values) (fmi2GetReal(c, references, count, values) == OK)
#define SET(c, references, count, values) (fmi2SetReal(c, references, count, values) == OK)
#define CALL(name) fmi2##name
#define STATE_CALL(name) fmi2##name##state
#define RATES fmi2GetDerivatives
#define READ_BACK fmi2DeSerializeFMUstate
typedef fmi2FMUstate kept_state;
typedef char kept_byte;
#else
#define OK fmi3OK
typedef fmi3Instance component;
fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                         fmi3Boolean, fmi3Boolean, const fmi3ValueReference[], size_t,
                                         fmi3InstanceEnvironment, fmi3LogMessageCallback,
                                         fmi3IntermediateUpdateCallback);
void fmi3FreeInstance(fmi3Instance);
fmi3Status fmi3EnterInitializationMode(fmi3Instance, fmi3Boolean, fmi3Float64, fmi3Float64, fmi3Boolean,
                                       fmi3Float64);
fmi3Status fmi3ExitInitializationMode(fmi3Instance);
fmi3Status fmi3SetBoolean(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Boolean[], size_t);
fmi3Status fmi3GetFloat64(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Float64[], size_t);
fmi3Status fmi3SetFloat64(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Float64[], size_t);
fmi3Status fmi3DoStep(fmi3Instance, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Boolean *, fmi3Boolean *,
                      fmi3Boolean *, fmi3Float64 *);
fmi3Status fmi3GetFMUState(fmi3Instance, fmi3FMUState *);
fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState *);
fmi3Status fmi3SerializeFMUState(fmi3Instance, fmi3FMUState, fmi3Byte[], size_t);
fmi3Status fmi3DeserializeFMUState(fmi3Instance, const fmi3Byte[], size_t, fmi3FMUState *);
fmi3Status fmi3SetFMUState(fmi3Instance, fmi3FMUState);
fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3GetContinuousStates(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3SetContinuousStates(fmi3Instance, const fmi3Float64[], size_t);
fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3GetEventIndicators(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance, fmi3Boolean *, fmi3Boolean *, fmi3Boolean *, fmi3Boolean *,
                                    fmi3Boolean *, fmi3Float64 *);
fmi3Status fmi3GetDirectionalDerivative(fmi3Instance, const fmi3ValueReference[], size_t,
                                        const fmi3ValueReference[], size_t, const fmi3Float64[], size_t,
                                        fmi3Float64[], size_t);
fmi3Status fmi3Reset(fmi3Instance);
fmi3Status fmi3Terminate(fmi3Instance);

static component begun(const char *guid)
{
    return fmi3InstantiateCoSimulation("host", guid, "", 0, 0, 0, 0, NULL, 0, NULL, NULL, NULL);
}
static int initialised(component c)
{
    const fmi3ValueReference play = PLAY;
    const fmi3Boolean on = fmi3True;
    return fmi3EnterInitializationMode(c, 1, 1e-7, 0.0, 0, 0.0) == OK &&
           fmi3SetBoolean(c, &play, 1, &on, 1) == OK && fmi3ExitInitializationMode(c) == OK;
}
static int stepped(component c, double now, double size)
{
    fmi3Boolean event, terminate, early;
    double last;
    return fmi3DoStep(c, now, size, 1, &event, &terminate, &early, &last) == OK;
}
static int updated(component c)
{
    fmi3Boolean said[5];
    double next;
    return fmi3UpdateDiscreteStates(c, said, said + 1, said + 2, said + 3, said + 4, &next) == OK;
}
static int directional(component c, const unsigned *unknowns, size_t rows, const unsigned *knowns,
                       size_t columns, const double *seed, double *found)
{
    return fmi3GetDirectionalDerivative(c, unknowns, rows, knowns, columns, seed, columns, found, rows) == OK;
}
#define GET(c, references, count, values) (fmi3GetFloat64(c, references, count, values, count) == OK)
#define SET(c, references, count, values) (fmi3SetFloat64(c, references, count, values, count) == OK)
#define CALL(name) fmi3##name
#define STATE_CALL(name) fmi3##name##State
#define RATES fmi3GetContinuousStateDerivatives
#define READ_BACK fmi3DeserializeFMUState
typedef fmi3FMUState kept_state;
typedef uint8_t kept_byte;
#endif

#define CHECK(holds)                                                                                          \
    do {                                                                                                      \
        if (!(holds)) {                                                                                       \
            fprintf(stderr, "failed: %s\n", #holds);                                                          \
            return 1;                                                                                         \
        }                                                                                                     \
    } while (0)

/* Every kind of call, with every variable. */
static int others(component c)
{
    static const unsigned counts[] = {0,           MODEL_STATES,  MODEL_STATES,  MODEL_PARAMETERS,
                                      MODEL_INPUTS, MODEL_OUTPUTS, MODEL_SWITCHES, MODEL_SWITCHES};
    double values[MODEL_STATES + MODEL_PARAMETERS + MODEL_OUTPUTS + MODEL_SWITCHES + MODEL_INPUTS + 1];
    unsigned unknowns[MODEL_STATES + MODEL_OUTPUTS];
    kept_state kept = NULL, again = NULL;
    kept_byte *bytes = malloc(sizeof(plant));
    CHECK(bytes != NULL && STATE_CALL(GetFMU)(c, &kept) == OK);
    for (unsigned kind = STATE; kind <= INDICATOR; ++kind) {
        for (unsigned number = 0; number < counts[kind]; ++number) {
            const unsigned reference = kind * KIND + number;
            CHECK(GET(c, &reference, 1, values));
            CHECK(SET(c, &reference, 1, values) == (kind != RATE && kind != OUTPUT && kind != INDICATOR));
        }
        const unsigned beyond = kind * KIND + counts[kind];
        CHECK(!GET(c, &beyond, 1, values) && !SET(c, &beyond, 1, values));
    }
    CHECK(CALL(GetContinuousStates)(c, values, MODEL_STATES) == OK);
    CHECK(CALL(SetContinuousStates)(c, values, MODEL_STATES) == OK);
    CHECK(CALL(SetContinuousStates)(c, values, MODEL_STATES + 1) != OK);
    CHECK(RATES(c, values, MODEL_STATES) == OK);
    CHECK(CALL(GetNominalsOfContinuousStates)(c, values, MODEL_STATES) == OK);
    CHECK(CALL(GetEventIndicators)(c, values, MODEL_SWITCHES) == OK);
    CHECK(updated(c));
    for (unsigned i = 0; i < MODEL_STATES; ++i) {
        unknowns[i] = RATE * KIND + i;
    }
    for (unsigned i = 0; i < MODEL_OUTPUTS; ++i) {
        unknowns[MODEL_STATES + i] = OUTPUT * KIND + i;
    }
    for (unsigned kind = STATE; kind <= INPUT; kind += INPUT - STATE) {
        for (unsigned number = 0; number < counts[kind]; ++number) {
            const unsigned known = kind * KIND + number;
            const double seed = 1.0;
            CHECK(directional(c, unknowns, MODEL_STATES + MODEL_OUTPUTS, &known, 1, &seed, values));
        }
    }
    CHECK(STATE_CALL(SerializeFMU)(c, kept, bytes, sizeof(plant)) == OK);
    CHECK(READ_BACK(c, bytes, sizeof(plant), &again) == OK && STATE_CALL(SetFMU)(c, again) == OK);
    CHECK(STATE_CALL(FreeFMU)(c, &kept) == OK && STATE_CALL(FreeFMU)(c, &again) == OK);
    free(bytes);
    return 0;
}

int main(int count, char **arguments)
{
    const unsigned position = OUTPUT * KIND;
    CHECK(count == 3 && begun("{another}") == NULL);
    const int steps = atoi(arguments[2]);
    component c = begun(arguments[1]);
    CHECK(c != NULL && initialised(c));
    for (int step = 0; step < steps; ++step) {
        double value;
        CHECK(stepped(c, 1e-3 * step, 1e-3) && GET(c, &position, 1, &value));
        fwrite(&value, sizeof value, 1, stdout);
        if (step == steps / 2) {
            CHECK(others(c) == 0);
        }
    }
    CHECK(!stepped(c, -1.0, 1e-3) && CALL(Terminate)(c) == OK && CALL(Reset)(c) == OK);
    CALL(FreeInstance)(c);
    return 0;
}
