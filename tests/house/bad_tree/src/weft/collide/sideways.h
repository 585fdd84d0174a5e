#pragma once
#include "weft/cloth/cloth.h"
