// Must not compile with -DFAIL: widening called the wrong way round.
#include "reference/types/widen.hpp"

int main() {
  const ulpgate::MpfrReal<62> x(1);
#ifdef FAIL
  return static_cast<int>(ulpgate::widen<double>(x));
#else
  return static_cast<int>(ulpgate::widen<ulpgate::MpfrReal<248> >(x));
#endif
}
