// The sums that a spot's normal equations are made of. The model is a product of a factor in x and one in y,
// so they run over rows first, column by column, and over columns then. The lanes of a vector are eight
// columns of one spot (spot_fit) or the same column of eight spots (lone_spots).
#pragma once

#include "components/extractor/lanes.hpp"

namespace omma {

// Over the rows: of the weight times products of the row's factors E, D = ∂E/∂v, S = ∂E/∂σ, and of the
// weighted residual times the factors.
struct ColumnSums {
  Floats ee, ed, es, dd, ds, ss, e, d, s, one;
  Floats re, rd, rs, r, rr;

  /// @param row_e, row_d, row_s  the row's factors: floats, or Floats
  template <class Factor>
  [[gnu::always_inline]] void add(const Floats& w, const Floats& residual, const Factor& row_e,
                                  const Factor& row_d, const Factor& row_s) {
    const Floats wr = w * residual;
    const Floats we = w * row_e;
    const Floats wd = w * row_d;
    const Floats ws = w * row_s;
    one += w;
    e += we;
    d += wd;
    s += ws;
    ee += we * row_e;
    ed += we * row_d;
    es += we * row_s;
    dd += wd * row_d;
    ds += wd * row_s;
    ss += ws * row_s;
    r += wr;
    re += wr * row_e;
    rd += wr * row_d;
    rs += wr * row_s;
    rr += wr * residual;
  }
};

// Over the columns: of products of the model's derivatives by flux (a), width (s), background (b) and place
// (u, v), the flux taken out of all but the first, and of the residual times them (g).
struct NormalSums {
  Floats aa, as, ab, au, av, ss, sb, su, sv, bb, bu, bv, uu, uv, vv;
  Floats ga, gs, gb, gu, gv, rr;

  /// @param e, d, s  the column's factors
  [[gnu::always_inline]] void add(const ColumnSums& c, const Floats& e, const Floats& d, const Floats& s) {
    const Floats e_ee = e * c.ee;
    const Floats e_ed = e * c.ed;
    const Floats by_sigma = s * c.ee + e * c.es;
    aa += e * e_ee;
    as += e * by_sigma;
    ab += e * c.e;
    au += d * e_ee;
    av += e * e_ed;
    ss += s * by_sigma + e * (s * c.es + e * c.ss);
    sb += s * c.e + e * c.s;
    su += d * by_sigma;
    sv += e * (s * c.ed + e * c.ds);
    bb += c.one;
    bu += d * c.e;
    bv += e * c.d;
    uu += d * d * c.ee;
    uv += d * e_ed;
    vv += e * e * c.dd;
    ga += e * c.re;
    gs += s * c.re + e * c.rs;
    gb += c.r;
    gu += d * c.re;
    gv += e * c.rd;
    rr += c.rr;
  }
};

// The two shapes that a round model leaves out: their scores and informations, the flux taken out.
struct ShapeSums {
  Floats skew_score, skew_information, stretch_score, stretch_information;

  [[gnu::always_inline]] void add(const ColumnSums& c, const Floats& e, const Floats& d, const Floats& s) {
    skew_score += d * c.rd;
    skew_information += d * d * c.dd;
    stretch_score += s * c.re - e * c.rs;
    stretch_information += s * (s * c.ee - 2.0F * e * c.es) + e * e * c.ss;
  }
};

}  // namespace omma
