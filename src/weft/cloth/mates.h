#pragma once

#include <initializer_list>

#include "weft/core/thread_team.h"
#include "weft/geometry_image.h"
#include "weft/grid.h"

namespace weft {

// Passes over the classes of mates, by one worker's share of them. Each class is one particle, so
// no two workers write to the same sample; callers place barriers before and after.

/// Every sample of a class gets the sum over it, added in ascending order of samples.
void sum_over_mates(const BorderMates& mates, Worker& worker,
                    std::initializer_list<Grid<float>*> planes);

/// The same by one worker for all classes.
void sum_over_mates(const BorderMates& mates, std::initializer_list<Grid<float>*> planes);

/// Every sample of a class gets the mean over it.
void average_over_mates(const BorderMates& mates, Worker& worker,
                        std::initializer_list<Grid<float>*> planes);

/// The same by one worker for all classes.
void average_over_mates(const BorderMates& mates, std::initializer_list<Grid<float>*> planes);

/// Every sample of a class gets the value of its representative.
void copy_to_mates(const BorderMates& mates, Worker& worker,
                   std::initializer_list<Grid<float>*> planes);

}  // namespace weft
