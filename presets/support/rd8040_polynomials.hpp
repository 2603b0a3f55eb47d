// Polynomials (16) to (23) of the PSO identification of the damper RD-8040-1, as printed; SI units, i in A, f in Hz.
#pragma once

namespace hysteron::rd8040 {

inline double square(double x) { return x * x; }
inline double cube(double x) { return square(x) * x; }

inline double beta(double i, double f) {
  return 4849 - 7181 * i - 6711 * f + 12710 * square(i) - 3351 * i * f + 6999 * square(f) - 6816 * cube(i) +
         1304 * square(i) * f + 567 * i * square(f) - 1987 * cube(f);
}
inline double gamma(double i, double f) {
  return 1935 - 5041 * i - 1416 * f + 5105 * square(i) + 3102 * i * f + 691.4 * square(f) - 2027 * cube(i) -
         833.1 * square(i) * f - 941.6 * i * square(f);
}
inline double A(double i, double f) {
  return 4571 + 12170 * i - 13450 * f - 9567 * square(i) + 1860 * i * f + 13230 * square(f) + 3103 * cube(i) -
         1018 * square(i) * f + 1010 * i * square(f) - 3651 * cube(f);
}
inline double k1(double i, double f) {
  return -763.1 + 7391 * i - 2259 * f - 9788 * square(i) - 1964 * i * f + 3227 * square(f) + 2903 * cube(i) +
         4754 * square(i) * f - 280.1 * i * square(f) - 999.6 * cube(f);
}
inline double k0(double i, double f) {
  return 2382 - 11770 * i - 1424 * f + 15660 * square(i) - 1224 * i * f + 276.4 * square(f) - 5140 * cube(i) -
         7164 * square(i) * f + 2444 * i * square(f);
}
inline double c0(double i, double f) {
  return 175 + 279.8 * i + 65.43 * f + 2142 * square(i) - 152.4 * i * f - 844 * cube(i) - 390.1 * square(i) * f;
}
inline double c1(double i, double f) {
  return 24850 + 33860 * i - 65570 * f + 21510 * square(i) - 41610 * i * f + 55930 * square(f) - 21170 * cube(i) +
         7301 * square(i) * f + 13040 * i * square(f) - 14610 * cube(f);
}
inline double f0(double i, double f) {
  return 4.989 - 124.6 * i - 2.643 * f + 325.2 * square(i) + 33.53 * i * f - 179.4 * cube(i) - 16.38 * square(i) * f;
}

}  // namespace hysteron::rd8040
