// Must not compile with -DFAIL: arithmetic between two levels of a family without the opt-in header.
#include "reference/types/widen.hpp"

int main() {
  const ulpgate::MpfrReal<62> x(1);
  const ulpgate::RealHP<4, ulpgate::MpfrReal<62>> y(2);
#ifdef FAIL
  return static_cast<int>(x + y);
#else
  return static_cast<int>(ulpgate::widen<ulpgate::RealHP<4, ulpgate::MpfrReal<62>>>(x) + y);
#endif
}
