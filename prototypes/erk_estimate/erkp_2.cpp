#include "erkp_scenes.h"
#include "erkp_null.h"
int main(){ 
 for(int p=3;p<=7;++p) for(bool end:{false,true}) { auto e=nul::exact(p,end); for(auto&w:e){ printf("p=%d end=%d:",p,end); for(double x:w)printf(" %9.2e",x); printf("\n"); } }
 double nd=0; for(double x:verner87.d) nd+=x*x; printf("|d|=%g\n",std::sqrt(nd));
 auto e6=nul::exact(6,false); auto e5=nul::exact(5,false), e5e=nul::exact(5,true), e4=nul::exact(4,false), e3=nul::exact(3,false);
 auto s=scenes()[0]; // self-similar: r=(9/2)^{1/3} (T-t)^{2/3}, T-t=1 at start
 V<double> y={std::cbrt(4.5),0,-2.0/3*std::cbrt(4.5),0};
 for(double x=0.03;x<0.99;x*=1.06){ Step<double,decltype(s.f)> st(2,s.f); auto z=st.go(0,y,x); double u=1-x; double qt=std::cbrt(4.5)*std::cbrt(u*u), vt=-2.0/3*std::cbrt(4.5)/std::cbrt(u);
  auto fn=[&](const std::array<double,14>&w,int c){double q=0;for(int j=0;j<14;++j)q+=w[j]*st.k[j][c];return x*q;};
  auto nr=[&](const std::array<double,14>&w){return std::hypot(fn(w,0),fn(w,2));};
  std::array<double,14> d{}; for(int j=0;j<13;++j)d[j]=verner87.d[j]; std::array<double,14> D{}; D[12]=1;D[13]=-1;
  printf("x=%.4f true q %9.2e v %9.2e | e7 q %9.2e v %9.2e | e6 %9.2e %9.2e | dis %9.2e %9.2e | e5 %9.2e %9.2e e4 %.2e e3 %.2e\n",x,z[0]-qt,z[2]-vt,fn(d,0),fn(d,2),fn(e6[0],0),fn(e6[0],2),fn(D,0),fn(D,2),nr(e5[0]),nr(e5[1]),nr(e4[0]),nr(e3[0])); }
}
