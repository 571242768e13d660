// The same in C++: makes and evaluates a surface, and catches an error.
#include <planish.hpp>

#include <iostream>

int main() {
  const std::vector<double> knots = {0, 0, 1, 1}, values = {0, 1, 1, 2};
  const planish::surface surface = planish::tensor_new(1, 1, 1, knots, knots, values);
  try {
    surface.value(2, 2);
  } catch (const planish::error &error) {
    std::cout << "planish " << planish::version() << ": " << surface.value(0.25, 0.5)[0] << ", " << error.what() << '\n';
    return error.status() != PLANISH_STATUS_OUTSIDE;
  }
  return 1;
}
