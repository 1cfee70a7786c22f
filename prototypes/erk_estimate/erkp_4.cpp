#include "erkp_scenes.h"
#include "erkp_null.h"
int main(int argc,char**argv){ int mode=argc>1?atoi(argv[1]):0; double K=argc>2?atof(argv[2]):1; argc=1; auto N3=nul::exact(3,false),N4=nul::exact(4,false),N6=nul::exact(6,false); std::string only=argc>1?argv[1]:""; double onlytol=argc>2?atof(argv[2]):0; 
 for(auto& s: scenes()){ if(!only.empty()&&s.name.find(only)!=0) continue;
  for(double tol : {1e-4,1e-6,1e-8,1e-10,1e-12}){ if(onlytol&&tol!=onlytol) continue;
   Step<double,decltype(s.f)> st(s.n,s.f); V<double> y=s.q0; y.insert(y.end(),s.v0.begin(),s.v0.end()); double t=0,h=0.3*std::pow(tol,0.125)*s.time; int steps=0,fail=0; std::vector<double> ratio,te; int n=s.n; double worst=0;
   while(t<s.T*(1-1e-12) && steps<20000){ double hh=std::min(h,s.T-t); auto z=st.go(t,y,hh); auto norm=[&](auto g){double q=0;for(int c=0;c<2*n;++c){double w=(c<n?s.length:s.length/s.time)*tol; double e=g(c)/w; q+=e*e;} return std::sqrt(q/(2*n));};
     double e7=norm([&](int c){return hh*st.d(c);}); double dis=norm([&](int c){return hh*(st.k[12][c]-st.k[13][c]);});
     auto fn=[&](const std::vector<std::array<double,14>>&B){double q=0; for(auto&b:B){double e=norm([&](int c){double u=0;for(int j=0;j<14;++j)u+=b[j]*st.k[j][c];return hh*u;}); q+=e*e;} return std::sqrt(q);}; double E3=fn(N3),E4=fn(N4),E6=std::hypot(fn(N6),e7/32.03); double rr=E4/E3; double g=mode==0?0:mode==1?K*E6*rr*rr:K*E6*E6/E4; if(mode==1) g=std::min(g,K*E6); e7=std::max(e7,g); double e=std::max(e7,dis*tol/0.05); if(!(e<1e300)) e=1e300;
     double fac=0.8*std::pow(e,-0.125);
     if(e>1){ h=hh*std::max(fac,0.2); ++fail; if(h<1e-14) break; continue;}
     auto w=truth(s,t,y,hh,1e-3*tol<1e-15?1e-15:1e-3*tol); double tr=w.empty()?1e99:norm([&](int c){return (double)((ld)z[c]-w[c]);});
     if(onlytol) printf("t=%.6f h=%.3e e7=%.3e dis=%.3e true=%.3e ratio=%.2f r=%.4f\n",t,hh,e7,dis,tr,tr/e7,std::hypot(y[0],y[1]));
     ratio.push_back(tr/e7); te.push_back(tr); worst=std::max(worst,tr);
     t+=hh; y=z; ++steps; h=hh*std::min(6.0,fac); }
   std::sort(ratio.begin(),ratio.end()); auto q=[&](double p){return ratio.empty()?0:ratio[(size_t)(p*(ratio.size()-1))];};
   printf("%-14s %.0e steps %5d fail %4d true/est med %.3f p90 %.3f p99 %.3f max %.3g | worst true/tol %.3g t=%.5f\n",s.name.c_str(),tol,steps,fail,q(.5),q(.9),q(.99),q(1),worst,t);
  } } }
