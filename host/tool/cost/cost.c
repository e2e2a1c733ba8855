/* The model of cost: a weight per event. */
#include "cost.h"

#define COST(event, instructions) [GN_COUNT_##event] = (instructions),
static const double weight[GN_COUNT_N] = {
#include "cost_table.h"
};

const int cost_error_percent = COST_ERROR_PERCENT;

double cost_instructions(const count_all *counts)
{
    double sum = 0;
    for (int i = 0; i < GN_COUNT_N; i++) sum += weight[i] * (double)counts->n[i];
    return sum;
}
