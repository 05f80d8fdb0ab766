# The height map of an island as a PGM picture: a mountain, a lower one, and two hills before them. Black is the sea.
function hill(x, y, wide, high,   from) {
  from = (x * x + y * y) / (wide * wide)
  return from < 1 ? high * (1 - from) * (1 - from) : 0
}
BEGIN {
  print "P2\n64 48\n255"
  for (y = 0; y < 48; y++)
    for (x = 0; x < 64; x++) {
      h = hill(x - 22, y - 18, 20, 250) + hill(x - 46, y - 22, 14, 160) + hill(x - 32, y - 33, 13, 95) + hill(x - 12, y - 30, 9, 50)
      printf "%d%s", (h > 255) ? 255 : h, x < 63 ? " " : "\n"
    }
}
