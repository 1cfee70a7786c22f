#pragma once
#include <array>
#include <vector>
#include <functional>
#include <cstdio>
#include <cmath>
#include <string>
#include <algorithm>
#include <Eigen/Dense>
#define DALEMBERT_HIDDEN
#include "erkp_verner.h"
using dalembert::verner87;
typedef long double ld;
template<class R> using V = std::vector<R>;
// a scene: n coordinates, y = (q, v)
struct Scene {
  std::string name; int n; double T; double length, time;
  V<double> q0, v0;
  std::function<void(double, const double*, const double*, double*)> f;
  std::function<void(ld, const ld*, const ld*, ld*)> F;
};
template<class R, class Fn> struct Step {
  int n; const Fn& f; V<V<R>> k; 
  Step(int n_, const Fn& f_) : n(n_), f(f_), k(14, V<R>(2*n_)) {}
  void rhs(R t, const V<R>& y, V<R>& out){ for(int i=0;i<n;++i) out[i]=y[n+i]; f(t,y.data(),y.data()+n,out.data()+n);}    
  V<R> go(R t, const V<R>& y, R h, bool end=true){
    V<R> Y(2*n); rhs(t,y,k[0]);
    for(int i=1;i<13;++i){ for(int c=0;c<2*n;++c){R s=0; for(int j=0;j<i;++j) if(verner87.a[i][j]!=0) s+=R(verner87.a[i][j])*k[j][c]; Y[c]=y[c]+h*s;} rhs(t+R(verner87.c[i])*h,Y,k[i]); }
    for(int c=0;c<2*n;++c){R s=0; for(int j=0;j<13;++j) s+=R(verner87.b[j])*k[j][c]; Y[c]=y[c]+h*s;}
    if(end) rhs(t+h,Y,k[13]);
    return Y; }
  R d(int c) const { R s=0; for(int j=0;j<13;++j) s+=R(verner87.d[j])*k[j][c]; return s; }
};
// truth: adaptive in long double
inline V<ld> truth(const Scene& s, double t0, const V<double>& y0, double h, double tol){
  Step<ld,decltype(s.F)> st(s.n,s.F); V<ld> y(y0.begin(),y0.end()); ld t=0, step=h/4.0L; long count=0;
  while(t<h){ ld hh=std::min(step,(ld)h-t); V<ld> z=st.go(t0+t,y,hh,false); ld e=0; for(int c=0;c<2*s.n;++c){ ld w=(c<s.n?s.length:s.length/s.time)*tol; e=std::max(e,std::abs(hh*st.d(c))/w);} 
    if(!(e<=1)){ step=hh*std::max((ld)0.1L,0.8L*std::pow(e,-0.125L)); if(!(e<1e300L)) step=hh*0.25L; if(step<1e-12L*h||++count>200000) return {}; continue;}
    t+=hh; y=z; step=hh*std::min((ld)3,0.8L*std::pow(e+1e-30L,-0.125L)); if(++count>200000) return {}; }
  return y; }
