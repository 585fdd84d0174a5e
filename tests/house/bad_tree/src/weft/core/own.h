#pragma once

std::vector<int> own();
