/* The types and functions of FMI 2.0 that an FMU for model exchange and co-simulation has.
 *
 * Written from the standard (Functional Mock-up Interface 2.0, fmi-standard.org), so that the sources need no
 * other file. Defining FMI2_FUNCTION_PREFIX puts a prefix before all functions, to link several FMUs.
 */
#ifndef MCKIBBEN_FMI2_H
#define MCKIBBEN_FMI2_H

#include <stddef.h>

typedef void *fmi2Component;
typedef void *fmi2ComponentEnvironment;
typedef void *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char *fmi2String;
typedef char fmi2Byte;

enum { fmi2False = 0, fmi2True = 1 };
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum {
    fmi2DoStepStatus,
    fmi2PendingStatus,
    fmi2LastSuccessfulTime,
    fmi2Terminated
} fmi2StatusKind;

typedef struct {
    void (*logger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void *(*allocateMemory)(size_t, size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded;
    fmi2Boolean terminateSimulation;
    fmi2Boolean nominalsOfContinuousStatesChanged;
    fmi2Boolean valuesOfContinuousStatesChanged;
    fmi2Boolean nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

#if defined(_WIN32)
#define FMI2_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI2_EXPORT __attribute__((visibility("default")))
#else
#define FMI2_EXPORT
#endif

#define FMI2_JOINED(a, b) a##b
#define FMI2_JOIN(a, b) FMI2_JOINED(a, b)
#ifdef FMI2_FUNCTION_PREFIX
#define FMI2(name) FMI2_JOIN(FMI2_FUNCTION_PREFIX, name)
#else
#define FMI2(name) name
#endif

/* The words of fmi.c. */
#define FMI_VERSION 2
#define FMI(name) FMI2(fmi2##name)
#define FMI_EXPORT FMI2_EXPORT
#define FMI_TYPE(type) fmi2##type
#define FMI_REAL(way) FMI2(fmi2##way##Real)
#define FMI_STATE(way) FMI_STATE_OF(way)
#define FMI_STATE_OF(way) FMI2(fmi2##way##FMUstate)
#define FMI_STATE_SIZE FMI2(fmi2SerializedFMUstateSize)
#define FMI_DESERIALIZE DeSerialize
#define FMI_RATES FMI2(fmi2GetDerivatives)
#define PLACES
#define TOO_FEW(count) 0
#define UNUSED_PLACES (void)0
typedef fmi2Component fmiInstance;
typedef fmi2Status fmiStatus;
typedef fmi2ValueReference fmiValueReference;
typedef fmi2Real fmiReal;
typedef fmi2Boolean fmiBoolean;
typedef fmi2String fmiString;
typedef fmi2FMUstate fmiState;
typedef fmi2Byte fmiByte;
#define fmiOK fmi2OK
#define fmiError fmi2Error

#endif
