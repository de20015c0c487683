// A ring of the outer radius 1: gmsh -2 ring.geo -o ring.msh
// and a thick one:              gmsh -2 ring.geo -setnumber thickness 0.6 -setnumber around 20 -setnumber across 2 -o thick_ring.msh
DefineConstant[thickness = 0.1];
DefineConstant[around = 12];  // elements of a quarter
DefineConstant[across = 1];
Point(1) = {0, 0, 0};
For q In {0:3}
  Point(10 + q) = {Cos(q*Pi/2), Sin(q*Pi/2), 0};
  Point(20 + q) = {(1 - thickness)*Cos(q*Pi/2), (1 - thickness)*Sin(q*Pi/2), 0};
EndFor
For q In {0:3}
  Circle(10 + q) = {10 + q, 1, 10 + (q + 1)%4};
  Circle(20 + q) = {20 + q, 1, 20 + (q + 1)%4};
  Line(30 + q) = {20 + q, 10 + q};
EndFor
For q In {0:3}
  Curve Loop(q + 1) = {30 + q, 10 + q, -(30 + (q + 1)%4), -(20 + q)};
  Plane Surface(q + 1) = {q + 1};
  Transfinite Curve{10 + q, 20 + q} = around + 1;
  Transfinite Curve{30 + q} = across + 1;
  Transfinite Surface{q + 1};
  Recombine Surface{q + 1};
EndFor
Physical Surface("ring") = {1, 2, 3, 4};
Physical Curve("outer") = {10, 11, 12, 13};
Physical Curve("inner") = {20, 21, 22, 23};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.MshFileVersion = 4.1;
