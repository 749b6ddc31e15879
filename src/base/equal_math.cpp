// SPDX-License-Identifier: Apache-2.0
// The functions of the C library's libm come in a variant for each kind of processor, and those differ in the last bit;
// products must not. So they are defined here, for this program and for every library in it (PROJ works positions out with
// them), by SLEEF's variants of one order of operations, without fused ones; all are right within 1 ulp. A sine is one with
// the sine of sincos(), for compilers join a sine and a cosine as they like.
#include <sleef.h>

extern "C" {
double sin(double x) noexcept { return Sleef_cinz_sincosd1_u10purec(x).x; }
double cos(double x) noexcept { return Sleef_cinz_sincosd1_u10purec(x).y; }
void sincos(double x, double* sine, double* cosine) noexcept {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(x);
  *sine = both.x;
  *cosine = both.y;
}
double tan(double x) noexcept { return Sleef_cinz_tand1_u10purec(x); }
double asin(double x) noexcept { return Sleef_cinz_asind1_u10purec(x); }
double acos(double x) noexcept { return Sleef_cinz_acosd1_u10purec(x); }
double atan(double x) noexcept { return Sleef_cinz_atand1_u10purec(x); }
double atan2(double y, double x) noexcept { return Sleef_cinz_atan2d1_u10purec(y, x); }
double sinh(double x) noexcept { return Sleef_cinz_sinhd1_u10purec(x); }
double cosh(double x) noexcept { return Sleef_cinz_coshd1_u10purec(x); }
double tanh(double x) noexcept { return Sleef_cinz_tanhd1_u10purec(x); }
double asinh(double x) noexcept { return Sleef_cinz_asinhd1_u10purec(x); }
double acosh(double x) noexcept { return Sleef_cinz_acoshd1_u10purec(x); }
double atanh(double x) noexcept { return Sleef_cinz_atanhd1_u10purec(x); }
double exp(double x) noexcept { return Sleef_cinz_expd1_u10purec(x); }
double exp2(double x) noexcept { return Sleef_cinz_exp2d1_u10purec(x); }
double expm1(double x) noexcept { return Sleef_cinz_expm1d1_u10purec(x); }
double log(double x) noexcept { return Sleef_cinz_logd1_u10purec(x); }
double log2(double x) noexcept { return Sleef_cinz_log2d1_u10purec(x); }
double log10(double x) noexcept { return Sleef_cinz_log10d1_u10purec(x); }
double log1p(double x) noexcept { return Sleef_cinz_log1pd1_u10purec(x); }
double pow(double x, double y) noexcept { return Sleef_cinz_powd1_u10purec(x, y); }
double cbrt(double x) noexcept { return Sleef_cinz_cbrtd1_u10purec(x); }
double erf(double x) noexcept { return Sleef_cinz_erfd1_u10purec(x); }

float sinf(float x) noexcept { return static_cast<float>(sin(static_cast<double>(x))); }
float cosf(float x) noexcept { return static_cast<float>(cos(static_cast<double>(x))); }
void sincosf(float x, float* sine, float* cosine) noexcept {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(static_cast<double>(x));
  *sine = static_cast<float>(both.x);
  *cosine = static_cast<float>(both.y);
}
float tanf(float x) noexcept { return static_cast<float>(tan(static_cast<double>(x))); }
float atan2f(float y, float x) noexcept {
  return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}
float expf(float x) noexcept { return static_cast<float>(exp(static_cast<double>(x))); }
float exp2f(float x) noexcept { return static_cast<float>(exp2(static_cast<double>(x))); }
float logf(float x) noexcept { return static_cast<float>(log(static_cast<double>(x))); }
float log2f(float x) noexcept { return static_cast<float>(log2(static_cast<double>(x))); }
float log10f(float x) noexcept { return static_cast<float>(log10(static_cast<double>(x))); }
float powf(float x, float y) noexcept {
  return static_cast<float>(pow(static_cast<double>(x), static_cast<double>(y)));
}
}
