#include "ground/draw/star_text.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "components/catalogue/star_names.hpp"

namespace omma::ground {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 24> kGreek{
    {{"Alp", "α"}, {"Bet", "β"}, {"Gam", "γ"}, {"Del", "δ"}, {"Eps", "ε"}, {"Zet", "ζ"},
     {"Eta", "η"}, {"The", "θ"}, {"Iot", "ι"}, {"Kap", "κ"}, {"Lam", "λ"}, {"Mu", "μ"},
     {"Nu", "ν"},  {"Xi", "ξ"},  {"Omi", "ο"}, {"Pi", "π"},  {"Rho", "ρ"}, {"Sig", "σ"},
     {"Tau", "τ"}, {"Ups", "υ"}, {"Phi", "φ"}, {"Chi", "χ"}, {"Psi", "ψ"}, {"Ome", "ω"}}};
constexpr std::array<std::string_view, 10> kSuperscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

}  // namespace

std::string star_text(std::uint16_t hr) {
  std::string label(star_label(hr).view());
  if (!proper_name(hr).empty()) return label;
  for (const auto& [latin, greek] : kGreek) {
    if (label.rfind(latin, 0) != 0) continue;
    std::string text(greek);
    std::size_t next = latin.size();
    if (next < label.size() && label[next] >= '0' && label[next] <= '9') {
      text += kSuperscripts[static_cast<std::size_t>(label[next] - '0')];
      ++next;
    }
    if (next < label.size() && label[next] != ' ') text += ' ';
    return text + label.substr(std::min(next, label.size()));
  }
  return label;
}

}  // namespace omma::ground
