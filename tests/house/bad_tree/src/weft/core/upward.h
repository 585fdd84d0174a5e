#pragma once
#include "weft/mesh/triangle_mesh.h"
