// Prints the errors of all closed forms, as a table in Markdown.
#include <cstdio>
#include <exception>

#include "closed_form.hpp"

int main() {
  using namespace tumble::physics;
  std::printf("| what | right | ");
  for (const double h : k_step_sizes) std::printf("%g ms | ", 1e3 * h);
  std::printf("order | expected |\n|---|---|");
  for ([[maybe_unused]] const double h : k_step_sizes) std::printf("---|");
  std::printf("---|---|\n");
  for (const ClosedForm& form : closed_forms()) {
    std::printf("| %s | %s |", form.name.c_str(), form.formula.c_str());
    std::vector<double> errors;
    try {
      for (const double h : k_step_sizes) errors.push_back(largest_error(form, h));
      for (const double error : errors) std::printf(" %.1e |", error);
    } catch (const std::exception& error) {
      std::printf(" %s |\n", error.what());
      continue;
    }
    if (form.order == 0.0) {
      std::printf(" | exact |\n");
    } else {
      std::printf(" %.2f | %g |\n", observed_order(errors), form.order);
    }
  }
}
