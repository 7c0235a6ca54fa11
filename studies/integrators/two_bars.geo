// Two bars of length L, a gap apart along x. The right one is higher on either side and has one row more: where corners and
// nodes would meet each other, round-off would decide what touches what.
DefineConstant[ L = 1, H = 0.25, more = 0.01, gap = 1e-4, n = 8 ];
For i In {0:1}
  x = i*(L + gap) - L - gap/2;
  low = -i*more;
  high = H + i*more;
  p = newp;
  Point(p) = {x, low, 0};
  Point(p + 1) = {x + L, low, 0};
  Point(p + 2) = {x + L, high, 0};
  Point(p + 3) = {x, high, 0};
  c = newc;
  For k In {0:3}
    Line(c + k) = {p + k, p + (k + 1)%4};
  EndFor
  Curve Loop(10 + i) = {c:c + 3};
  Plane Surface(1 + i) = {10 + i};
  Transfinite Curve{c, c + 2} = n + 1;
  Transfinite Curve{c + 1, c + 3} = 2 + i;
  Transfinite Surface{1 + i} Alternate;
EndFor
Physical Surface("left") = {1};
Physical Surface("right") = {2};
