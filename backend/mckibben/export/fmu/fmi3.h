/* The types of FMI 3.0 that an FMU for model exchange and co-simulation has.
 *
 * Written from the standard (Functional Mock-up Interface 3.0, fmi-standard.org), so that the sources need no
 * other file. Defining FMI3_FUNCTION_PREFIX puts a prefix before all functions, to link several FMUs.
 */
#ifndef MCKIBBEN_FMI3_H
#define MCKIBBEN_FMI3_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef void *fmi3Instance;
typedef void *fmi3InstanceEnvironment;
typedef void *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef char fmi3Char;
typedef const fmi3Char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;
typedef bool fmi3Clock;

#define fmi3True true
#define fmi3False false

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum {
    fmi3Independent,
    fmi3Constant,
    fmi3Fixed,
    fmi3Tunable,
    fmi3Discrete,
    fmi3Dependent
} fmi3DependencyKind;
typedef enum {
    fmi3IntervalNotYetKnown,
    fmi3IntervalUnchanged,
    fmi3IntervalChanged
} fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean,
                                               fmi3Boolean, fmi3Boolean, fmi3Boolean *, fmi3Float64 *);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3UnlockPreemptionCallback)(void);

#if defined(_WIN32)
#define FMI3_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI3_EXPORT __attribute__((visibility("default")))
#else
#define FMI3_EXPORT
#endif

#define FMI3_JOINED(a, b) a##b
#define FMI3_JOIN(a, b) FMI3_JOINED(a, b)
#ifdef FMI3_FUNCTION_PREFIX
#define FMI3(name) FMI3_JOIN(FMI3_FUNCTION_PREFIX, name)
#else
#define FMI3(name) name
#endif

/* The words of fmi.c. */
#define FMI_VERSION 3
#define FMI(name) FMI3(fmi3##name)
#define FMI_EXPORT FMI3_EXPORT
#define FMI_TYPE(type) fmi3##type
#define FMI_REAL(way) FMI3(fmi3##way##Float64)
#define FMI_STATE(way) FMI_STATE_OF(way)
#define FMI_STATE_OF(way) FMI3(fmi3##way##FMUState)
#define FMI_STATE_SIZE FMI3(fmi3SerializedFMUStateSize)
#define FMI_DESERIALIZE Deserialize
#define FMI_RATES FMI3(fmi3GetContinuousStateDerivatives)
#define PLACES , size_t places
#define TOO_FEW(count) (places < (count))
#define UNUSED_PLACES (void)places
typedef fmi3Instance fmiInstance;
typedef fmi3Status fmiStatus;
typedef fmi3ValueReference fmiValueReference;
typedef fmi3Float64 fmiReal;
typedef fmi3Boolean fmiBoolean;
typedef fmi3String fmiString;
typedef fmi3FMUState fmiState;
typedef fmi3Byte fmiByte;
#define fmiOK fmi3OK
#define fmiError fmi3Error

#endif
