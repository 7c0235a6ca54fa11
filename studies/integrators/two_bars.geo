// Two bars of length L and height H, a gap apart along x. The right one has one row more, so that no node meets a node.
DefineConstant[ L = 1, H = 0.25, gap = 1e-4, n = 8 ];
For i In {0:1}
  x = i*(L + gap) - L - gap/2;
  p = newp;
  Point(p) = {x, 0, 0};
  Point(p + 1) = {x + L, 0, 0};
  Point(p + 2) = {x + L, H, 0};
  Point(p + 3) = {x, H, 0};
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
