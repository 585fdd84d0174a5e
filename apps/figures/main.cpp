#include <cstdio>
#include <exception>

#include "apps/figures/figures.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: weft_figures FOLDER\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    weft::figures::draw_input(folder);
    weft::figures::draw_cuts(folder);
    weft::figures::draw_maps(folder);
    weft::figures::draw_images(folder);
    weft::figures::draw_papers(folder);
    weft::figures::draw_filters(folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "weft_figures: error: %s\n", error.what());
    return 1;
  }
  return 0;
}
