#pragma once
#include "weft/core/math.h"
