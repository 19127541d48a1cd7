/* What an importer asks of a plant, without the words of a version of FMI: variables by value reference,
 * derivatives, events, steps. What returns a text returns NULL, or a sentence that says what is wrong. */
#ifndef ACCESS_H
#define ACCESS_H

#include "plant.h"

#include <stddef.h>

/* Value references are a kind times KIND plus a number. */
enum {
    KIND = 100000,
    STATE = 1,
    RATE = 2,
    PARAMETER = 3,
    INPUT = 4,
    OUTPUT = 5,
    SWITCH = 6,
    INDICATOR = 7
};
enum { PLAY = 0 /* the only Boolean */, TIME = 800000 };

const char *plant_get(plant *it, const unsigned references[], size_t count, double values[]);
const char *plant_set(plant *it, const unsigned references[], size_t count, const double values[]);
/* Of the states: their values, rates and magnitudes; of the switches: their event indicators. */
const char *plant_get_states(const plant *it, double states[], size_t count);
const char *plant_set_states(plant *it, const double states[], size_t count);
const char *plant_get_rates(plant *it, double rates[], size_t count);
const char *plant_get_nominals(double nominals[], size_t count);
const char *plant_get_indicators(plant *it, double indicators[], size_t count);
/* Changes of unknowns (rates and outputs) with changes of knowns (states and inputs). */
const char *plant_directional(plant *it, const unsigned unknowns[], size_t unknown_count,
                              const unsigned knowns[], size_t known_count, const double known_changes[],
                              double changes[]);
/* The begin of a run; whether a tolerance is stated. */
const char *plant_begin(plant *it, double start, int stated, double tolerance);
/* A step of co-simulation; inputs are then held. */
const char *plant_step(plant *it, double now, double size);

#endif
