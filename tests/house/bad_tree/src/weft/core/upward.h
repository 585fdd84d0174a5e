#pragma once
#include "weft/mesh.h"
