# Two logs of the same experiment (log.csv), aligned at their first row with a reference that moves or
# a duty: prints how many rows both have before a fault, and how far apart the counts are at most. A
# serial line's real rate delays the start of the one, and after a fault nothing holds the axes together.
function column(name,    i) {
  for (i = 1; i <= NF; ++i) if ($i == name) return i
}
function apart(a, b) {
  return a > b ? a - b : b - a
}
BEGIN { FS = "," }
FNR == 1 {
  ++file
  row = begun = 0
  y = column("y_count"); x = column("x_count"); fault = column("fault")
  y_speed = column("y_reference_velocity_m_per_s"); x_speed = column("x_reference_velocity_m_per_s")
  y_duty = column("y_duty_pct"); x_duty = column("x_duty_pct")
  next
}
$y_speed != 0 || $x_speed != 0 || $y_duty != 0 || $x_duty != 0 { begun = 1 }
begun && $fault == 0 && file == 1 { ++row; y_of[row] = $y; x_of[row] = $x }
begun && $fault == 0 && file == 2 && ++row in y_of {
  ++compared
  if (apart($y, y_of[row]) > worst) worst = apart($y, y_of[row])
  if (apart($x, x_of[row]) > worst) worst = apart($x, x_of[row])
}
END { print compared + 0, worst + 0 }
