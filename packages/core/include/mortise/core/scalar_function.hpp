#pragma once
// A scalar function as a value: a constant, or whatever code computes.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"

namespace mortise {

/// A scalar function, as of pseudo-time t and reference position x, y, z. Copies are cheap and share what computes the value.
class ScalarFunction {
 public:
  /// Computes the value from the arguments, in their order, beyond which there may be more.
  using Body = std::function<double(const std::vector<double>& arguments)>;

  /// The constant `value`.
  ScalarFunction(double value = 0.0);

  /// The constant `value`, which messages show as `source`, given at `place`.
  ScalarFunction(double value, std::string source, Place place);

  /// The function that `body` computes, which messages show as `source`, given at `place`.
  /// @param reads  [arguments] 1 for one that it depends on, else 0; empty: it is not known
  ScalarFunction(Body body, std::string source, Place place = {}, std::vector<char> reads = {});

  /// Value at `arguments`; not finite where the function has none.
  double at(const std::vector<double>& arguments) const;

  /// Value of a function of t, x, y, z or the first of them. Throws InputError if it is not finite.
  double operator()(double t = 0.0, double x = 0.0, double y = 0.0, double z = 0.0) const;

  bool is_constant() const;                     ///< depends on none of its arguments
  bool depends_on(std::size_t argument) const;  ///< is known to depend on one of them, by its place
  const std::string& source() const;            ///< as messages show it; of a constant its shortest exact text unless given
  const Place& place() const;                   ///< where it was given; may be empty

 private:
  struct Content;
  std::shared_ptr<const Content> content_;
};

}  // namespace mortise
