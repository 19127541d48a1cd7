/* The model between its equations (model.h) and the interface: one instance, its solver. */
#ifndef PLANT_H
#define PLANT_H

#include "model.h"

/* Arrays have at least one element: C99 knows none without. */
#define PLANT_ROOM(count) ((count) > 0 ? (count) : 1)

typedef struct {
    double time; /* s */
    double y[PLANT_ROOM(MODEL_STATES)];
    double w[PLANT_ROOM(MODEL_SWITCHES)];
    double p[PLANT_ROOM(MODEL_PARAMETERS)];
    double k[PLANT_ROOM(MODEL_CONSTANTS)];
    double u[PLANT_ROOM(MODEL_INPUTS)];      /* as set by the caller, at u_time */
    double u_rate[PLANT_ROOM(MODEL_INPUTS)]; /* their rates, as set by the caller */
    double u_time;
    double tolerance; /* relative error of a step */
    double step;      /* s, that the solver tries next */
    int play;         /* whether the inputs of the document are played */
    int piece;        /* of those inputs */
    int prepared;     /* whether k belongs to p */
} plant;

/* Values of the document. */
void plant_reset(plant *it);
/* k of p, if a parameter has changed. */
void plant_prepare(plant *it);
/* Inputs at a time, and their rates until the next piece or the next step of the caller. */
void plant_inputs(const plant *it, double time, double *u);
void plant_input_rates(const plant *it, double *rates);
/* The piece of the inputs at it->time; where the next one begins, or HUGE_VAL. */
void plant_enter_piece(plant *it);
double plant_next_piece(const plant *it);
/* Changes the switches whose guards are violated; whether any has changed. */
int plant_settle(plant *it);
/* d rates / d states and d rates / d inputs, by rows. */
void plant_jacobian(const double *y, const double *k, const double *u, const double *w, double *matrix);
void plant_input_jacobian(const double *y, const double *k, const double *u, const double *w, double *matrix);

enum { PLANT_DONE = 0, PLANT_STEP_TOO_SMALL = 1, PLANT_NOT_FINITE = 2, PLANT_CHATTERS = 3, PLANT_TOO_STIFF = 4 };
/* Integrates to a time, over switches and pieces of the inputs. */
int plant_advance(plant *it, double end);

#endif
