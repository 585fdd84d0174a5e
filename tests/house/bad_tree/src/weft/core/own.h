#pragma once

int own();
