// Runs one program of a page and compares what it prints with what the page shows.
#include "pages/compare.h"
#include "pages/program.h"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

namespace {

/// What a program prints, by whatever function.
std::string output_of(void (*run)()) {
  std::FILE* const file = std::tmpfile();
  const int screen = dup(STDOUT_FILENO);
  dup2(fileno(file), STDOUT_FILENO);
  const auto restore = [&] {
    std::cout.flush();
    std::fflush(stdout);
    dup2(screen, STDOUT_FILENO);
    close(screen);
  };
  try {
    run();
  } catch (...) {
    restore();
    throw;
  }
  restore();
  std::fseek(file, 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::ftell(file)), '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string_view name = argc == 2 ? argv[1] : "";
  for (const pages::Program& program : pages::programs()) {
    if (program.name != name) continue;
    const std::string printed = output_of(program.run);
    std::cout << printed;
    const std::string wrong = program.shown.empty() ? "" : pages::difference(program.shown, printed);
    if (!wrong.empty()) std::cerr << name << ": " << wrong << '\n';
    return wrong.empty() ? 0 : 1;
  }
  std::cerr << "no program \"" << name << "\"; there are:\n";
  for (const pages::Program& program : pages::programs()) std::cerr << program.name << '\n';
  return 2;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
