#include "weft/cloth/cloth.h"
