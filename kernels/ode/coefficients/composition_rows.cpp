// The published composition methods: their digits and where these stand in print.
#include "kernels/ode/coefficients/composition_rows.hpp"

#include <array>

namespace ulpgate::ode {
namespace {

using Text = std::string_view;

constexpr std::array<Text, 1> kOne = {"1"};
// 1/(2 - 2^(1/3)) and -2^(1/3)/(2 - 2^(1/3)).
constexpr std::array<Text, 2> kForestRuth = {"1.351207191959657634", "-1.702414383919315268"};
// 1/(4 - 4^(1/3)) twice, and 1 - 4 of it.
constexpr std::array<Text, 3> kSuzuki4 = {"0.4144907717943757371423540628607614957118",
                                          "0.4144907717943757371423540628607614957118",
                                          "-0.6579630871775029485694162514430459828471"};
// xi, lambda, chi.
constexpr std::array<Text, 3> kPefrl = {"0.1786178958448091", "-0.2123418310626054", "-0.06626458266981849"};
// Table 1, solution A: w3, w2, w1, w0 = 1 - 2 (w1 + w2 + w3).
constexpr std::array<Text, 4> kYoshida6 = {"0.784513610477560", "0.235573213359357", "-1.17767998417887",
                                           "1.315186320683906"};
// Table 2, solution D: w7 ... w1, w0 = 1 - 2 (w1 + ... + w7).  Solved, they differ from print by up
// to 2.8e-13, in the last three of the 15 digits.
constexpr std::array<Text, 8> kYoshida8 = {"0.914844246229740",  "0.253693336566229", "-1.44485223686048",
                                           "-0.158240635368243", "1.93813913762276",  "-1.96061023297549",
                                           "0.102799849391985",  "1.708453070786998"};
// As printed by E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), V.3.2.
constexpr std::array<Text, 8> kSuzukiUmeno8 = {
    "0.74167036435061295344822780",  "-0.40910082580003159399730010", "0.19075471029623837995387626",
    "-0.57386247111608226665638773", "0.29906418130365592384446354",  "0.33462491824529818378495798",
    "0.31529309239676659663205666",  "-0.79688793935291635401978884"};
// As printed there.
constexpr std::array<Text, 18> kSofroniouSpaletta10 = {
    "0.07879572252168641926390768",  "0.31309610341510852776481247",  "0.02791838323507806610952027",
    "-0.22959284159390709415121340", "0.13096206107716486317465686",  "-0.26973340565451071434460973",
    "0.07497334315589143566613711",  "0.11199342399981020488957508",  "0.36613344954622675119314812",
    "-0.39910563013603589787862981", "0.10308739852747107731580277",  "0.41143087395589023782070412",
    "-0.00486636058313526176219566", "-0.39203335370863990644808194", "0.05194250296244964703718290",
    "0.05066509075992449633587434",  "0.04967437063972987905456880",  "0.04931773575959453791768001"};

constexpr std::array kRows = {
    CompositionRow{"leapfrog",
                   1,
                   1,
                   CompositionKind::symplectic_euler,
                   {},
                   "L. Verlet, Phys. Rev. 159 (1967) 98, with v(0) used as v(-h/2): J. Kozicki, A. Gladky, "
                   "K. Thoeni, Comput. Phys. Commun. 270 (2022) 108167"},
    CompositionRow{"velocity_verlet", 2, 1, CompositionKind::kick_first, kOne,
                   "W. C. Swope, H. C. Andersen, P. H. Berens, K. R. Wilson, J. Chem. Phys. 76 (1982) 637"},
    CompositionRow{"forest_ruth", 4, 3, CompositionKind::drift_first, kForestRuth,
                   "E. Forest, R. D. Ruth, Physica D 43 (1990) 105"},
    CompositionRow{
        "ruth3", 3, 3, CompositionKind::ruth3, {}, "R. D. Ruth, IEEE Trans. Nucl. Sci. 30 (1983) 2669"},
    CompositionRow{"suzuki4", 4, 5, CompositionKind::kick_first, kSuzuki4,
                   "M. Suzuki, Phys. Lett. A 146 (1990) 319"},
    CompositionRow{"pefrl", 4, 4, CompositionKind::position_extended_fr, kPefrl,
                   "I. P. Omelyan, I. M. Mryglod, R. Folk, Comput. Phys. Commun. 146 (2002) 188"},
    CompositionRow{"yoshida6", 6, 7, CompositionKind::kick_first, kYoshida6,
                   "H. Yoshida, Phys. Lett. A 150 (1990) 262, table 1, solution A"},
    CompositionRow{"yoshida8", 8, 15, CompositionKind::kick_first, kYoshida8,
                   "H. Yoshida, Phys. Lett. A 150 (1990) 262, table 2, solution D"},
    CompositionRow{"suzuki_umeno8", 8, 15, CompositionKind::kick_first, kSuzukiUmeno8,
                   "M. Suzuki, K. Umeno, in Computer Simulation Studies in Condensed-Matter Physics VI "
                   "(1993) 74; R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151"},
    CompositionRow{"sofroniou_spaletta10", 10, 35, CompositionKind::kick_first, kSofroniouSpaletta10,
                   "M. Sofroniou, G. Spaletta, Optim. Methods Softw. 20 (2005) 597"},
};

}  // namespace

std::span<const CompositionRow> composition_rows() {
  return kRows;
}

const CompositionRow* find_composition(std::string_view name) {
  for (const CompositionRow& row : kRows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace ulpgate::ode
