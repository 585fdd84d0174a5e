#pragma once
#include "weft/nothing.h"
