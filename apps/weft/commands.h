#pragma once

#include "apps/weft/context.h"

namespace CLI {
class App;
}

namespace weft::app {

// One function a subcommand, each in a file of its name: adds the subcommand and its options to the
// program; the context is filled when the command runs and must outlive the program's parsing.
void add_convert(CLI::App& program, const Context& context);
void add_rebuild(CLI::App& program, const Context& context);
void add_inspect(CLI::App& program, const Context& context);
void add_simulate(CLI::App& program, const Context& context);
void add_drape(CLI::App& program, const Context& context);
void add_garment(CLI::App& program, const Context& context);
void add_render(CLI::App& program, const Context& context);
void add_view(CLI::App& program, const Context& context);
void add_shapes(CLI::App& program, const Context& context);
void add_fabric(CLI::App& program, const Context& context);
void add_table5(CLI::App& program, const Context& context);
void add_demo(CLI::App& program, const Context& context);

}  // namespace weft::app
